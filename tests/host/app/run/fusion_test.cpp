// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include "support/temporary_folder.hpp"

#include <host/app/run/live_run.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <chrono>
#include <cmath>
#include <thread>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

namespace
{
/// Attends to a run until the condition holds. A compiler of low priority may take long on a busy machine.
template <typename F>
bool until (LiveRun& p, F&& isSo)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds (300);
    while (! isSo() && std::chrono::steady_clock::now() < end)
    {
        p.attend();
        std::this_thread::sleep_for (std::chrono::milliseconds (2));
    }
    return isSo();
}

bool isFused (const LiveRun& p) { return p.fusion() == "fused"; }

/// The forces that the motor receives, tick by tick. Calls `meanwhile` before each attend().
std::vector<double> forces (LiveRun& p, std::size_t ticks, const std::function<void()>& meanwhile)
{
    Traces::Client probe { p.traces() };
    probe.want ({ "motor.force" });
    p.start ({});
    const auto traces = [&] { return probe.of ("motor.force"); };
    REQUIRE (until (p, [&] {
        meanwhile();
        return traces().size() == 3 && traces()[0]->end() >= ticks;
    }));
    std::vector<double> all;
    for (std::size_t k = 0; k < ticks; ++k)
        for (const auto& t : traces())
            all.push_back (k >= t->begin() ? t->at (k) : std::nan (""));
    return all;
}
}   // namespace

TEST_CASE ("the window fuses what runs, an edit runs by the plan at once, and is fused when hands rest", "[app][run][fuse]")
{
    const TemporaryFolder cache;
    const Fuser::Options how { .compiler = { .optimisation = "-O0", .cache = cache.path() } };
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun p { rig.document, catalogue() };
    CHECK (p.fusion().empty());
    p.fuse (how);
    CHECK (p.fusion() == "plan");
    p.start ({});
    REQUIRE (until (p, [&] { return p.fusion() == "plan, fusing"; }));
    REQUIRE (until (p, [&] { return isFused (p); }));

    REQUIRE (rig.document.perform (graph::SetParam { "", "drag", "mu", Json (0.5) }));
    p.attend();
    CHECK (p.fusion() == "plan");
    CHECK (until (p, [&] { return isFused (p); }));   // from the cache: the value of a parameter is no part of the code

    p.fuse (std::nullopt);
    CHECK (p.fusion().empty());
    CHECK (p.isRunning());
    CHECK_FALSE (hasErrors (p.messages()));
}

TEST_CASE ("a compiler that cannot be started is a warning in the window, and the graph keeps running", "[app][run][fuse]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun p { rig.document, catalogue() };
    p.fuse (Fuser::Options { .compiler = { .compiler = "/no/such/compiler", .llvm = "/no/such/program" } });
    p.start ({});
    const auto isWarning = [] (const Message& m) { return m.id == "fuse/no_compiler" && m.severity == Message::Severity::warning; };
    REQUIRE (until (p, [&] { return std::ranges::any_of (p.messages(), isWarning); }));
    CHECK (p.fusion() == "plan");
    CHECK (p.isRunning());
}

TEST_CASE ("switching the fusion on and off in the window does not change the forces at the motor", "[app][run][fuse]")
{
    constexpr std::size_t ticks = 6000;
    const TemporaryFolder cache;
    const Fuser::Options how { .compiler = { .optimisation = "-O0", .cache = cache.path() } };
    CanvasRig quiet { CanvasRig::preset ("dry_wood") }, busy { CanvasRig::preset ("dry_wood") };
    LiveRun plan { quiet.document, catalogue() }, changing { busy.document, catalogue() };
    const auto expected = forces (plan, ticks, [] {});
    plan.letGo();
    const auto compile = [&] (LiveRun& p) {   // fills the cache, with the probe, which is part of the code
        p.fuse (how);
        static_cast<void> (forces (p, 1, [] {}));
        REQUIRE (until (p, [&] { return isFused (p); }));
        p.letGo();
        p.fuse (std::nullopt);
    };
    compile (changing);
    int swaps = 0;
    const auto got = forces (changing, ticks, [&] {
        const bool is_on = isFused (changing);
        if (! is_on && ! changing.fusion().empty()) return;   // it takes two looks to fuse
        ++swaps;
        changing.fuse (is_on ? std::nullopt : std::optional (how));
    });
    CHECK (swaps > 20);

    std::size_t compared = 0, different = 0, pushed = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
        if (std::isnan (expected[i]) || std::isnan (got[i])) continue;
        ++compared;
        different += std::bit_cast<std::uint64_t> (expected[i]) != std::bit_cast<std::uint64_t> (got[i]) ? 1 : 0;
        pushed += expected[i] != 0.0 ? 1 : 0;
    }
    CHECK (different == 0);
    CHECK (compared > expected.size() / 2);   // a busy machine may drop some probe samples
    CHECK (pushed > 1000);
}
