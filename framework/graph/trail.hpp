// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace tactus::graph
{

/// A permanent identity. Names are only addresses; state follows the id through renaming and regrouping. Unique in a process,
/// not written to files.
using Id = std::uint64_t;

Id newId() noexcept;   // [any thread]

struct Wire;
struct Command;
struct Graph;

/// How a graph came to be as it is, so that compile() need not look at all of it again after a small edit. Only apply() writes it;
/// it is not saved. A copy of a graph has the same version until one of them is edited.
struct Trail
{
    /// The new state of a wire of the graph itself; empty if the wire was removed.
    struct WireStep
    {
        Id id = 0;
        std::shared_ptr<const Wire> now {};
    };

    /// An edit that changed wires of the graph itself, or nothing that is compiled.
    struct Step
    {
        Id before = 0;   ///< version of the graph before the edit
        std::vector<WireStep> wires {};
    };

    static constexpr std::size_t most = 32;

    Id version = newId();         ///< of the graph as it is now
    std::vector<Step> steps {};   ///< the latest edits, oldest first; at most `most`. Another kind of edit clears them
};

/// The changes of wires since a version, oldest first; nullopt if other things have changed, or if nothing is known.
std::optional<std::vector<Trail::WireStep>> wiresSince (const Trail&, Id version);

/// Adds a command that has changed the graph. [main thread]
void note (Graph&, const Command&);

}   // namespace tactus::graph
