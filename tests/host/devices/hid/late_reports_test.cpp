// SPDX-License-Identifier: MIT
// Reports that come late, in bursts, with jitter, or not at all, and clocks that lie: the speed that a guard sees is that of the tool. In virtual time.

#include <host/devices/hid/profile_reader.hpp>
#include <host/devices/hid/reading_judge.hpp>
#include <tactus/run/clock/passed_time.hpp>
#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <random>
#include <string>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
constexpr Nanoseconds ms = 1'000'000;
constexpr double limit = 2.0, watchdog = 0.02;

enum class Says
{
    nothing,
    number,
    time
};

std::shared_ptr<const Profile> boardThat (Says says)
{
    const std::string key = says == Says::number ? R"(, "sequence": "count")" : says == Says::time ? R"(, "timestamp": "time")"
                                                                                                   : "";
    auto loaded = readProfileText (R"({"format": "tactus-profile", "version": 1, "id": "board", "name": "Board", "sources": ["a test"],
        "match": [{"vid": 1}], "rate": 1000, "position": ["x", "y", "z"], "inputs": [{"length": 20, "verified": true, "fields": [
            {"name": "count", "at": 0, "type": "u32le"}, {"name": "time", "at": 4, "type": "u32le", "scale": "1 us"},
            {"name": "x", "at": 8, "type": "s32le", "scale": "10 nm"}, {"name": "y", "at": 12, "type": "s32le", "scale": "10 nm"},
            {"name": "z", "at": 16, "type": "s32le", "scale": "10 nm"}])"
                                   + key + "}]}");
    for (const auto& m : loaded.messages)
        UNSCOPED_INFO (m.where << ": " << m.text);
    REQUIRE (loaded.profile);
    return loaded.profile;
}

/// A device whose tool moves on a circle, at a constant speed, and what a guard makes of its reports.
struct Bench
{
    explicit Bench (Says says, bool has_run = false) : model (boardThat (says)), judge (model), is_of_run (has_run)
    {
        guard.prepare ({ .ramp = 0.0, .watchdog = watchdog, .max_speed = limit }, 1e-3);
        judge.reconnect();
        judge.prepare();
    }

    /// The next report, which is measured a period after the last one.
    Bytes measure (double speed)
    {
        ++count;
        angle += speed * 1e-3 / radius;
        time_us += 1000.0 * clock_speed;
        Bytes b (20);
        const auto put = [&] (std::size_t at, auto v) { std::memcpy (b.data() + at, &v, 4); };
        put (0, count);
        put (4, static_cast<std::uint32_t> (std::llround (time_us)));
        put (8, static_cast<std::int32_t> (std::lround (1e8 * radius * std::cos (angle))));
        put (12, static_cast<std::int32_t> (std::lround (1e8 * radius * std::sin (angle))));
        return b;
    }

    /// A tick at this time, after the reports that have arrived until then.
    void tick (Nanoseconds at)
    {
        judge.begin();
        std::size_t n = 0;
        for (; n < waiting.size() && waiting[n].second <= at; ++n)
            judge.take (waiting[n].first, waiting[n].second);
        waiting.erase (waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t> (n));
        const double since = ticked == 0 ? 1e-3 : 1e-9 * static_cast<double> (at - ticked);
        const double passed = is_of_run ? passed_time (1e-9 * static_cast<double> (at), 0.0) : since;
        ticked = at;
        reading = judge.reading ({ .period_s = is_of_run ? 1e-3 : since, .now = at });
        force = guard ({ { 1.0, 0.0, 0.0 }, Vec3::Zero() }, reading, passed).force.x();
    }

    /// Ticks as HidClock does: for each report that arrives, and by a timer after five periods without one.
    void tickUntil (Nanoseconds until)
    {
        while (! waiting.empty() && waiting.front().second <= until)
        {
            while (waiting.front().second > ticked + 5 * ms)
                tick (ticked + (ticked + 5 * ms < waiting.front().second && silent ? ms : 5 * ms)), silent = true;
            silent = false;
            tick (waiting.front().second);
        }
    }

    static constexpr double radius = 0.05;
    HidModel model;
    ReadingJudge judge;
    Guard guard;
    PassedTime passed_time { 1e-3 };
    bool is_of_run;                                       // the guard is told the time as in a run, which leaves some of it to later ticks; else all of it
    std::vector<std::pair<Bytes, Nanoseconds>> waiting;   // and when each arrives, in this order
    Reading reading;
    std::uint32_t count = 0;
    double angle = 0.0, time_us = 0.0, clock_speed = 1.0, force = 0.0;
    Nanoseconds ticked = 0;
    bool silent = false;
};

/// A link between a device and this computer: when a report that is measured now arrives, or whether it is lost.
struct Link
{
    static constexpr Nanoseconds lost = -1;

    const char* name;
    std::function<Nanoseconds (std::mt19937&, std::uint32_t count, Nanoseconds now)> arrival;
    Nanoseconds longest;    // silence
    double fastest = 1.9;   // m/s, up to which there must be no stop
};

/// How ticks come, and up to which speed of the hand there must be no stop.
struct Ticking
{
    const char* name;
    bool by_timer;
    bool is_of_run;
    double latest_ms;   // after the time for which the timer was set
    double fastest;     // m/s
};

constexpr Ticking ticking[] {
    { "ticks by reports", false, false, 0.0, 1.9 },
    { "ticks by a timer", true, false, 0.0, 1.9 },
    { "ticks by reports, in the time of a run", false, true, 0.0, 1.8 },
    { "ticks by a timer that is late, in the time of a run", true, true, 0.4, 1.8 },
};

double uniform (std::mt19937& random) { return static_cast<double> (random()) / 4294967296.0; }

std::vector<Link> links()
{
    const auto after = [] (Nanoseconds now, double delay_ms) { return now + static_cast<Nanoseconds> (1e6 * delay_ms); };
    return {
        { "in time", [=] (auto&, auto, auto now) { return after (now, 0.2); }, ms },
        { "jitter", [=] (auto& r, auto, auto now) { return after (now, 0.9 * uniform (r)); }, 2 * ms },
        { "loss", [=] (auto& r, auto, auto now) { return uniform (r) < 0.15 ? Link::lost : after (now, 0.2 + 0.1 * uniform (r)); }, 12 * ms },
        // Every half second, one report is late, and those behind it are lost.
        { "one 12 ms late", [=] (auto&, auto k, auto now) { return k % 500 == 0 ? after (now, 12.2) : k % 500 < 12 ? Link::lost
                                                                                                                   : after (now, 0.2); }, 14 * ms },
        { "one 15 ms late", [=] (auto&, auto k, auto now) { return k % 500 == 0 ? after (now, 15.2) : k % 500 < 15 ? Link::lost
                                                                                                                   : after (now, 0.2); }, 17 * ms },
        // The late one comes first, and the others are right behind it.
        { "one 18 ms late", [=] (auto&, auto k, auto now) {
             const auto n = k % 500;
             return n < 18 ? after (now, n == 0 ? 17.9 : 18.9 - n) : after (now, 0.2);
         },
          19 * ms },
        // The link stalls for 10 ms, and then delivers what has queued up, at once or one by one.
        { "burst", [=] (auto&, auto k, auto now) { return k % 300 < 10 ? after (now, 10.2 - k % 300) : after (now, 0.2); }, 11 * ms },
        { "queue", [=] (auto&, auto k, auto now) { return k % 300 < 15 ? after (now, 10.2 - 0.7 * (k % 300)) : after (now, 0.2); }, 11 * ms },
        { "all", [=] (auto& r, auto k, auto now) {
             if (k % 97 < 2 + k / 97 % 9) return k % 97 == 0 ? after (now, 2.2 + static_cast<double> (k / 97 % 9)) : Link::lost;
             return uniform (r) < 0.05 ? Link::lost : after (now, 0.4 * uniform (r));
         },
          14 * ms },
    };
}

/// Sends a report over the link, in order.
void send (Bench& bench, const Link& link, std::mt19937& random, Nanoseconds now, double speed)
{
    auto report = bench.measure (speed);
    auto at = link.arrival (random, bench.count, now);
    if (at == Link::lost) return;
    if (! bench.waiting.empty()) at = std::max (at, bench.waiting.back().second);
    bench.waiting.emplace_back (std::move (report), at);
}
}   // namespace

TEST_CASE ("reports that are late, lost or in bursts make no hand seem too fast, and hide none that is", "[hid][safety]")
{
    std::uint64_t reports = 0, false_stops = 0, fast_hands = 0, missed = 0;
    Nanoseconds worst = 0;
    std::mt19937 random { 7 };
    for (const auto says : { Says::nothing, Says::number, Says::time })
        for (const auto& link : links())
            for (const auto& ticks : ticking)
            {
                // Without numbers, a silence of 17 periods counts as 16 lost reports, and that is another stop.
                if (says != Says::number && link.longest > 17 * ms) continue;
                for (const double speed : { 0.1, 0.4, 0.8, 1.2, 1.6, std::min (ticks.fastest, link.fastest) })
                {
                    if (ticks.is_of_run && speed != 0.8 && speed != ticks.fastest) continue;   // the others are tried without a run
                    INFO (static_cast<int> (says) << ", " << link.name << ", " << ticks.name << ", " << speed);
                    Bench bench { says, ticks.is_of_run };
                    bench.clock_speed = says == Says::time ? 1.0 + 0.02 * (uniform (random) - 0.5) : 1.0;
                    Nanoseconds now = 10 * ms;
                    std::uint64_t at_start = 0;
                    const auto step = [&] (double v) {
                        now += ms;
                        send (bench, link, random, now, v);
                        if (ticks.by_timer)
                            bench.tick (now + ms / 2 + static_cast<Nanoseconds> (ticks.latest_ms * 1e6 * uniform (random)));
                        else
                            bench.tickUntil (now + ms / 2);
                    };
                    for (int k = 0; k < 4000; ++k)
                    {
                        step (speed);
                        if (k == 60) at_start = bench.guard.events();   // before the first report
                    }
                    const auto stops = bench.guard.events() - at_start;
                    reports += bench.count;
                    false_stops += stops;
                    if (stops > 0) FAIL_CHECK (describe (bench.guard.latest()));

                    // And now the hand is torn away, at any phase of the faults of the link.
                    const int quiet = static_cast<int> (random() % 500);
                    for (int k = 0; k < quiet; ++k)
                        step (speed);
                    const auto begins = now;
                    while (bench.guard.stop() != Guard::Stop::speed && now < begins + 200 * ms)
                        step (3.0);
                    ++fast_hands;
                    const auto took = now - begins;
                    missed += took >= 200 * ms ? 1 : 0;
                    worst = std::max (worst, took);
                    // In time: as fast as the 5 ms of the filter allow. Otherwise, no later than that after the longest silence.
                    CHECK (took <= 8 * ms + (link.longest > ms ? 2 * link.longest : 0));
                    reports += static_cast<std::uint64_t> (took / ms + quiet);
                }
            }
    std::printf ("%llu reports: %llu false stops; %llu hands that are too fast: %llu missed, the latest seen after %.0f ms\n",
                 static_cast<unsigned long long> (reports), static_cast<unsigned long long> (false_stops), static_cast<unsigned long long> (fast_hands),
                 static_cast<unsigned long long> (missed), 1e-6 * static_cast<double> (worst));
    CHECK (reports >= 1'000'000);
    CHECK (false_stops == 0);
    CHECK (missed == 0);
}

TEST_CASE ("a clock that lies hides no real speed", "[hid][safety]")
{
    struct Lie
    {
        const char* name;
        std::function<double (std::mt19937&, int k)> speed;   // of the clock of the device
    };
    const Lie lies[] {
        { "frozen", [] (auto&, int k) { return k < 3000 ? 1.0 : 0.0; } },
        { "backwards", [] (auto&, int k) { return k < 3000 ? 1.0 : -1.0; } },
        { "twice as fast", [] (auto&, int) { return 2.0; } },
        { "half as fast", [] (auto&, int) { return 0.5; } },
        { "fast from now on", [] (auto&, int k) { return k < 3000 ? 1.0 : 5.0; } },
        { "slow from now on", [] (auto&, int k) { return k < 3000 ? 1.0 : 0.2; } },
        { "in jumps", [] (auto&, int k) { return k % 10 == 0 ? 9.0 : 0.1; } },
        { "saves up, and spends when the hand is fast", [] (auto&, int k) { return k < 2980 ? 1.0 : k < 2999 ? 0.05
                                                                                                             : 2.0; } },
        { "at random", [] (auto& r, int) { return 2.0 * uniform (r); } },
        { "far too fast", [] (auto&, int) { return 1000.0; } },
    };
    std::mt19937 random { 11 };
    for (const auto& lie : lies)
        for (const double before : { 0.0, 1.0 })
        {
            INFO (lie.name << ", from " << before << " m/s");
            Bench bench { Says::time };
            Nanoseconds now = 10 * ms;
            int k = 0;
            const auto step = [&] (double speed) {
                now += ms;
                bench.clock_speed = lie.speed (random, k++);
                bench.waiting.emplace_back (bench.measure (speed), now + ms / 5);
                bench.tick (now + ms / 2);
            };
            while (k < 3000)
                step (before);
            const auto begins = now;
            int pushing = 0;   // ms for which a force was on the fast tool
            while (now < begins + 500 * ms)
            {
                step (3.0);
                pushing += bench.force != 0.0 ? 1 : 0;
            }
            // 8 ms to see the speed, the lag that the watchdog allows, and the fade.
            CHECK (pushing <= 8 + 20 + 1 + 6);
            CHECK (bench.guard.stop() != Guard::Stop::none);
        }
}
