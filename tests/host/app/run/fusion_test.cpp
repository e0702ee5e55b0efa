// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/app/run/live_run.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

namespace
{
/// Attends to a run until the condition holds. A compiler of low priority may take a long time on a busy machine.
template <typename F>
bool until (LiveRun& p, F&& isSo)
{
    return tactus::test::eventually (std::chrono::milliseconds (2), tactus::test::looks_at_compiler, [&] {
        p.poll();
        return isSo();
    });
}

bool isFused (const LiveRun& p) { return p.fusion() == "fused"; }

/// The forces that the motor receives, from the tick `begin` on. NaN for ticks that were not recorded, because the reader was late.
struct Forces
{
    std::uint64_t begin = 0;
    std::vector<std::array<double, 3>> ticks;

    std::uint64_t end() const { return begin + ticks.size(); }
};

/// Plays until `isDone`, which gets the number of recorded ticks and is called before each poll().
Forces play (LiveRun& p, const std::function<bool (std::uint64_t)>& isDone)
{
    Traces::Client probe { p.traces() };
    probe.want ({ "motor.force" });
    p.start ({});
    const auto traces = [&] { return probe.of ("motor.force"); };
    REQUIRE (until (p, [&] { return isDone (traces().size() == 3 ? traces()[0]->end() : 0); }));
    Forces out { .begin = traces()[0]->begin(), .ticks = {} };
    for (auto k = out.begin; k < traces()[0]->end(); ++k)
        out.ticks.push_back ({ traces()[0]->at (k), traces()[1]->at (k), traces()[2]->at (k) });
    p.letGo();
    return out;
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
    p.poll();
    CHECK (p.fusion() == "plan");
    CHECK (until (p, [&] { return isFused (p); }));   // from the cache: the value of a parameter is not part of the code

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
    const TemporaryFolder cache;
    const Fuser::Options how { .compiler = { .optimisation = "-O0", .cache = cache.path() } };
    CanvasRig quiet { CanvasRig::preset ("dry_wood") }, busy { CanvasRig::preset ("dry_wood") };
    LiveRun plan { quiet.document, catalogue() }, changing { busy.document, catalogue() };
    changing.fuse (how);   // fills the cache, with the probe, which is part of the code
    static_cast<void> (play (changing, [&] (std::uint64_t ticks) { return ticks > 0 && isFused (changing); }));
    changing.fuse (std::nullopt);

    int swaps = 0;
    const auto got = play (changing, [&] (std::uint64_t ticks) {
        const bool is_on = isFused (changing);
        if (is_on || changing.fusion().empty())   // fusing takes two looks
        {
            ++swaps;
            changing.fuse (is_on ? std::nullopt : std::optional (how));
        }
        return ticks >= 6000 && swaps > 20;
    });
    const auto expected = play (plan, [&] (std::uint64_t ticks) { return ticks >= got.end(); });

    std::size_t compared = 0, different = 0, pushed = 0;
    for (auto k = std::max (got.begin, expected.begin); k < got.end(); ++k)
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            const double a = expected.ticks[k - expected.begin][axis], b = got.ticks[k - got.begin][axis];
            if (std::isnan (a) || std::isnan (b)) continue;
            ++compared;
            different += std::bit_cast<std::uint64_t> (a) != std::bit_cast<std::uint64_t> (b) ? 1 : 0;
            pushed += a != 0.0 ? 1 : 0;
        }
    CHECK (different == 0);
    CHECK (compared > 1000);   // a busy machine may drop some probe samples
    CHECK (pushed > 100);
}
