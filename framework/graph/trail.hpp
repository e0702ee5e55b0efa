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

/// The latest changes of a graph, so that compile() need not visit all of it after a small edit. The trail is complete because only History
/// writes it, and nothing else can change the graph of a History. Any other graph can change without a note in the trail, so a
/// copied or moved graph starts with an empty one. Not saved.
class Trail
{
public:
    /// The new state of a wire of the graph itself; empty if the wire was removed.
    struct WireStep
    {
        Id id = 0;
        std::shared_ptr<const Wire> now {};
    };

    Trail() = default;
    Trail (const Trail&) noexcept {}
    Trail& operator= (const Trail&) noexcept
    {
        forget();
        return *this;
    }

    Id version() const noexcept { return own_version; }   ///< of the graph as it is now

    /// The changes of wires since a version, oldest first; nullopt if anything else has changed, or the version is not in the trail.
    std::optional<std::vector<WireStep>> wiresSince (Id version) const;

private:
    friend class History;

    /// An edit that changed only wires of the graph itself, or nothing that affects the plan.
    struct Step
    {
        Id before = 0;   // version of the graph before the edit
        std::vector<WireStep> wires {};
    };

    void note (const Command&);   // a command that has changed the graph   [main thread]
    void forget() noexcept
    {
        own_version = newId();
        steps.clear();
    }

    static constexpr std::size_t most = 32;

    Id own_version = newId();
    std::vector<Step> steps;   // the latest edits, oldest first; at most `most`. Another kind of edit clears them
};

}   // namespace tactus::graph
