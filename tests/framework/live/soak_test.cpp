// SPDX-License-Identifier: MIT
// A long run with continuous edits. TACTUS_SOAK_TICKS makes it longer.

#include "support/chance_hand.hpp"
#include "support/no_allocation.hpp"
#include "support/random_edit.hpp"
#include "support/rounds.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <fstream>
#include <iostream>

#include <unistd.h>

using namespace tactus;

namespace
{
/// Resident memory in bytes; 0 if the system does not report it.
std::size_t memory()
{
    std::ifstream statm ("/proc/self/statm");
    std::size_t total = 0, resident = 0;
    statm >> total >> resident;
    return resident * static_cast<std::size_t> (sysconf (_SC_PAGESIZE));
}

/// A small model in which every bit affects the force, and separate nodes (e_*) that are edited.
test::Sketch wood()
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("wall", "deform.plane").node ("drag", "friction.elasto_plastic").node ("motor", "device.force");
    s.wire ("hand.position -> wall.position")
        .wire ("hand.position -> drag.position")
        .wire ("wall.resistance -> drag.normal_force")
        .wire ("wall.force -> motor.force")
        .wire ("drag.force -> motor.force");
    s.node ("e_a", "signal.noise").node ("e_b", "filter.one_pole").node ("e_motor", "device.force").wire ("e_a.out -> e_b.in");
    s.graph.root.nodes.back().role = "right";
    return s;
}
}   // namespace

TEST_CASE ("a million ticks with edits of other nodes leave the model bit-identical, and memory does not grow", "[live][soak]")
{
    const auto* wanted = std::getenv ("TACTUS_SOAK_TICKS");
    const auto ticks = wanted ? std::strtoull (wanted, nullptr, 10) : test::rounds (1'000'000ull);
    constexpr std::uint64_t step = 500;   // ticks between edits

    const auto sketch = wood();
    test::Live live { sketch.graph, catalogue(), {}, sketch.compile().plan };
    Engine alone { sketch.compile().plan };
    test::ChanceHand hand { 1 }, other { 1 };
    live.engine().attach ("stylus", hand);
    alone.attach ("stylus", other);

    std::mt19937 random { 1 };
    std::size_t settled = 0;
    int edits = 0;
    for (std::uint64_t k = 0; k < ticks; ++k)
    {
        if (k % step == 0)
        {
            // Edits are undone after a while, so that the graph and its history do not grow.
            if (live.history().position() > 20)
                while (live.history().position() > 0)
                    live.undo();
            auto messages = live.perform (test::randomEdit (random, live.graph(), "e_", "right"));
            while (hasErrors (messages))
                messages = live.undo();
            ++edits;
        }
        if (k == ticks / 2) settled = memory();
        live.engine().tick();
        alone.tick();
    }
    CHECK (hand.digest == other.digest);
    const auto grown = static_cast<double> (memory()) - static_cast<double> (settled);
    if (wanted) std::cout << ticks << " ticks, " << edits << " edits, memory " << settled << " bytes halfway, " << grown << " bytes more at the end\n";
    if (NoAllocation::watches) CHECK (grown < 2e6);   // a sanitizer keeps freed memory
}
