// SPDX-License-Identifier: MIT
// A tick makes no system calls.

#include "support/chance_hand.hpp"
#include "support/no_system_calls.hpp"
#include "support/random_edit.hpp"
#include "support/random_graph.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <csignal>
#include <thread>

#include <unistd.h>

using namespace tactus;

TEST_CASE ("a forbidden system call is detected", "[live]")
{
    if (! test::canForbidSystemCalls())
    {
        WARN ("skipped: seccomp filters are not available here");
        return;
    }
    CHECK (test::inChild ([] {
               test::forbidSystemCalls();
               return 7;
           })
               .status
           == 7);
    CHECK (test::inChild ([] {
               test::forbidSystemCalls();
               return getppid() > 0 ? 1 : 2;
           })
               .signal
           == SIGSYS);
}

TEST_CASE ("in a free run with edits at full speed, ticks make no system calls", "[live]")
{
    if (! test::canForbidSystemCalls())
    {
        WARN ("skipped: seccomp filters are not available here");
        return;
    }
    const auto graph = test::sideBySide (test::prefixed (test::randomGraph (5, 40), "s_", "left"), test::prefixed (test::randomGraph (6, 40), "e_", "right"));
    const auto end = test::inChild ([&] {
        auto [plan, messages] = compile (graph, catalogue(), { .rate_hz = 4000.0 });
        if (! plan) return 1;
        test::Live live { graph, catalogue(), { .rate_hz = 4000.0 }, plan };
        test::ChanceHand left { 1 }, right { 2 };
        live.engine().attach ("left", left);
        live.engine().attach ("right", right);
        std::atomic<int> edits = 0;
        std::thread editor { [&] {
            for (std::mt19937 random { 7 };; ++edits)
            {
                if (live.history().position() > 50)
                    while (live.history().position() > 0)
                        live.undo();
                auto found = live.perform (test::randomEdit (random, live.graph(), "e_", "right"));
                while (hasErrors (found))
                    found = live.undo();
                live.engine().clear();
            } } };

        test::forbidSystemCalls();   // applies to this thread
        int taken = 0;
        const Plan* last = nullptr;
        for (std::uint64_t k = 0; taken < 50 || k < 100000; ++k)
        {
            live.engine().tick();
            taken += last != &live.engine().plan();
            last = &live.engine().plan();
        }
        _exit (edits >= 50 ? 0 : 2);
    });
    CHECK (end.signal == 0);
    CHECK (end.status == 0);
}
