// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/catalogue.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// What every node promises, each promise with a function that tries to refute it. every_node_test.cpp checks the nodes of Tactus
/// against this list, and `tactus check-plugin` those of a plugin.
namespace tactus::examine
{

struct Examination
{
    std::string_view id;
    std::string_view promise;   ///< a sentence without a full stop
    int level;                  ///< 1 (always) to 10 (only in the longest checks)
    bool random;                ///< true: each seed is another trial; false: one trial is enough

    /// The reason why the promise does not apply to this node, or cannot be checked in this program; empty if it can be checked.
    std::string (*skipped) (const NodeType&);

    /// A description of how the node breaks the promise; empty if it does not. The same seed gives the same answer. Passes on what a hook throws.
    /// [any thread]
    std::string (*fault) (const NodeType&, unsigned seed);
};

/// All examinations, in the order in which they are made and reported.
std::span<const Examination> examinations() noexcept;

/// Throws std::invalid_argument if no examination has this id.
const Examination& examination (std::string_view id);

/// The number of trials of a random examination at a level from 1 to 10.
int trialsAt (int level) noexcept;

/// A hash of all outputs of a random run. It is the same in every process if the node keeps its promise to give the same bits.
std::uint64_t fingerprint (const NodeType&, unsigned seed);

/// The time of a tick in ns: the median over batches of ticks. Depends on the machine and its load. [main thread]
double tickTime (const NodeType&);

}   // namespace tactus::examine
