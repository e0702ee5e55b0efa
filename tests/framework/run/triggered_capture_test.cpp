// SPDX-License-Identifier: MIT
#include "support/no_allocation.hpp"

#include <support/property.hpp>
#include <tactus/run/probe/triggered_capture.hpp>

#include <catch2/catch.hpp>

#include <limits>
#include <thread>

using namespace tactus;

namespace
{
/// Two taps: one is captured, the other is watched.
struct Stand
{
    explicit Stand (bool has_taps = true) : plan (has_taps ? bothTaps() : std::vector<Tap> {}) {}

    std::vector<Tap> bothTaps() const
    {
        return { { .name = "seen", .unit = {}, .value = &seen }, { .name = "watched", .unit = {}, .value = &watched } };
    }

    std::unique_ptr<TriggeredCapture> capture (const Trigger& t) const
    {
        return std::make_unique<TriggeredCapture> (t, plan.serial(), std::vector<std::size_t> { 0, 1 }, 1);
    }

    double seen = 0.0, watched = 0.0;
    Plan plan;
};

bool isEdge (double before, double now, const Trigger& t)
{
    const bool rises = before < t.level && now >= t.level, falls = before > t.level && now <= t.level;
    return (rises && t.edge != Trigger::Edge::falling) || (falls && t.edge != Trigger::Edge::rising);
}
}   // namespace

TEST_CASE ("a window holds the ticks around the first edge that has enough ticks before it", "[runtime][property]")
{
    int complete = 0;
    test::property ("any signal, any trigger", [&] {
        const Trigger trigger {
            .level = 1.0,
            .edge = *rc::gen::element (Trigger::Edge::rising, Trigger::Edge::falling, Trigger::Edge::either),
            .before = *rc::gen::inRange<std::size_t> (0, 12),
            .after = *rc::gen::inRange<std::size_t> (0, 12),
        };
        const auto signal = *rc::gen::container<std::vector<double>> (60, rc::gen::element (0.0, 1.0, 2.0, std::numeric_limits<double>::quiet_NaN()));
        Stand stand;
        const auto capture = stand.capture (trigger);
        for (std::size_t k = 0; k < signal.size(); ++k)
        {
            stand.seen = static_cast<double> (k);
            stand.watched = signal[k];
            capture->note (stand.plan, k);
        }

        auto at = std::max<std::size_t> (1, trigger.before);
        while (at < signal.size() && ! isEdge (signal[at - 1], signal[at], trigger))
            ++at;
        RC_ASSERT (capture->isComplete() == (at + trigger.after < signal.size()));
        if (! capture->isComplete()) return;
        ++complete;
        RC_ASSERT (capture->triggeredAt() == at);
        for (std::size_t i = 0; i < trigger.ticks(); ++i)
            RC_ASSERT (capture->frame (i)[0] == static_cast<double> (at - trigger.before + i));
    });
    CHECK (complete > 3);
}

TEST_CASE ("a plan that is older than the capture is ignored", "[runtime]")
{
    Stand before { false }, stand;
    const auto capture = stand.capture ({ .level = 0.5 });
    capture->note (before.plan, 0);
    for (const double v : { 0.0, 1.0 })
    {
        stand.watched = v;
        CHECK_FALSE (capture->isComplete());
        capture->note (stand.plan, 1);
    }
    CHECK (capture->isComplete());
}

TEST_CASE ("captures can be armed and disarmed during ticking, and the tick allocates nothing", "[runtime][threads]")
{
    CaptureSlot slot;
    Stand stand;
    std::atomic<bool> done = false;
    int allocations = 0, locks = 0;
    std::jthread ticking ([&] {
        const NoAllocation watch;
        for (std::uint64_t k = 0; ! done; ++k)
        {
            stand.seen = static_cast<double> (k);
            stand.watched = static_cast<double> (k % 16);
            slot.note (stand.plan, k);
        }
        allocations = watch.allocations();
        locks = watch.locks();
    });

    int wrong = 0;
    for (int i = 0; i < 300; ++i)
    {
        slot.arm (stand.capture ({ .level = 8.0, .before = 3, .after = 20 }));
        if (i % 3 == 0) slot.arm (stand.capture ({ .level = 4.0, .before = 40, .after = 5 }));
        if (i % 5 == 0)
        {
            slot.disarm();
            wrong += slot.complete() != nullptr;
            continue;
        }
        const TriggeredCapture* capture = nullptr;
        while ((capture = slot.complete()) == nullptr)
            std::this_thread::yield();
        wrong += capture->triggeredAt() % 16 != static_cast<std::uint64_t> (capture->window().level);
        for (std::size_t t = 0; t < capture->window().ticks(); ++t)
            wrong += capture->frame (t)[0] != static_cast<double> (capture->triggeredAt() + t - capture->window().before);
    }
    done = true;
    ticking.join();
    CHECK (wrong == 0);
    if (NoAllocation::watches)
    {
        CHECK (allocations == 0);
        CHECK (locks == 0);
    }
}
