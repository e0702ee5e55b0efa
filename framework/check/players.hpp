// SPDX-License-Identifier: MIT
#pragma once

#include "bench.hpp"

#include <cstddef>
#include <vector>

/// Nodes that play by themselves, such as an lfo, and those that play when they are hit, such as a clip.
namespace tactus::check
{

/// True for a node that plays by itself or when it is hit: it has an input for hits, and no other input is wired.
bool isStruck (const plan::Flat&, int node);

/// The nodes that a device reaches and whose hits go to one that plays. They are silent where players are looked for: a node that only rings after a hit
/// is none.
std::vector<std::size_t> strikers (const plan::Flat&);

/// Finds the nodes that play by themselves, whatever the tools do.
class PlayerSearch
{
public:
    /// `number_of_ticks`: of the run.
    explicit PlayerSearch (std::size_t number_of_ticks) : ticks (number_of_ticks) {}

    void poll (const Plan& running);   ///< after each tick of a run

    const std::vector<std::size_t>& found() const noexcept { return found_nodes; }   ///< after the last tick

private:
    /// A node without a path from a device, other than by hits. It plays by itself if its outputs still change in the second half of the motion, or are 0
    /// again after a change. A node that only settles, such as a filter after a constant, does not play.
    struct Free
    {
        std::size_t node;
        std::vector<const double*> outputs;
        std::vector<double> first {}, middle {};
        bool changes = false, plays = false;

        void poll (bool is_second_half);
        bool hasPlayed() const;
    };

    std::size_t ticks, tick = 0;
    std::vector<Free> free {};
    std::vector<std::size_t> found_nodes {};

    void begin (const Plan& running);
};

/// The nodes that play by themselves, and that a device turns up or down. `forces`: of the motion. Runs the graph once, if there may be any.
std::vector<std::size_t> modulatedPlayers (const Subject&, const plan::Flat&, const HandMotion&, const Forces&);

}   // namespace tactus::check
