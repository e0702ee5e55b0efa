// SPDX-License-Identifier: MIT
// The fade between two plans. tests/framework/live has its effect on a device.
#include <tactus/run/guard/bumpless.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;

TEST_CASE ("without a switch, nothing is faded: an effort of -0 stays -0, as in exported code", "[engine]")
{
    Bumpless bumpless;
    bumpless.prepare (1.0 / 4000.0);
    const Effort wanted { .force = { 1.0, -0.0, 0.0 } };
    for (int k = 0; k < 100; ++k)
    {
        const auto& passed = bumpless (wanted);
        CHECK (passed.force == wanted.force);
        CHECK (std::signbit (passed.force.y()));
        CHECK_FALSE (std::signbit (passed.force.z()));
    }
}

TEST_CASE ("with new nodes, the effort of before stays until they have settled, and then fades to theirs", "[engine]")
{
    constexpr double rate_hz = 4000.0;
    Bumpless bumpless;
    bumpless.prepare (1.0 / rate_hz);
    const auto next = [&] (double force) { return bumpless (Effort { .force = { force, 0.0, 0.0 } }).force.x(); };
    next (1.0);
    bumpless.begin (true);
    const int settle = static_cast<int> (Bumpless::settle_s * rate_hz), rise = static_cast<int> (Bumpless::rise_s * rate_hz);
    for (int k = 0; k < settle; ++k)
        CHECK (next (k == 0 ? 0.0 : 10.0 - 0.1 * k) == 1.0);   // a wall that pushes a tool out which it did not know
    double before = 1.0;
    for (int k = 0; k <= rise; ++k)
    {
        const double now = next (2.0);
        CHECK (now >= before);
        CHECK (now - before <= 3.1416 / (2.0 * rise));
        before = now;
    }
    CHECK (next (2.0) == 2.0);

    bumpless.begin (true);
    bumpless.begin (false);   // an edit without new nodes during that time does not end it
    CHECK (next (5.0) == 2.0);
    CHECK (next (9.0) == 2.0);
    bumpless.stop (Effort { .force = { 0.5, 0.0, 0.0 } });   // the guard decides otherwise
    CHECK (next (9.0) == 9.0);
}

TEST_CASE ("no effort of a fade is larger than that of before and that of the new plan", "[engine]")
{
    constexpr double rate_hz = 4000.0, frequency = 100.0;
    for (const double force : { 0.0, 0.3, -0.8 })
        for (int phase = 0; phase < 8; ++phase)
        {
            Bumpless bumpless;
            bumpless.prepare (1.0 / rate_hz);
            const auto next = [&] (const Vec3& f, double signal) {
                Effort e { .force = f };
                e.axes.set (0, signal);
                e.signals.set (0, signal);
                return bumpless (e);
            };
            const Vec3 first { 0.0, 0.0, force };
            next (first, force);
            bumpless.begin (false);
            double last = force, steepest = 0.0;
            for (int k = 0; k < 1000; ++k)
            {
                const double wave = std::sin (6.283185307 * (frequency * k / rate_hz + phase / 8.0));
                const Vec3 wanted { 0.6 * wave, 0.0, 0.8 * wave };   // 1 N
                const auto passed = next (wanted, wave);
                for (int i = 0; i < 3; ++i)
                    CHECK (std::abs (passed.force[i]) <= std::max (std::abs (first[i]), std::abs (wanted[i])));
                CHECK (std::abs (passed.axes[0]) <= std::max (std::abs (force), std::abs (wave)));
                CHECK (std::abs (passed.signals[0]) <= std::max (std::abs (force), std::abs (wave)));
                steepest = std::max (steepest, std::abs (passed.signals[0] - last));
                last = passed.signals[0];
            }
            const double fade = std::max (std::abs (force) / Bumpless::fall_s, (1.0 + std::abs (force)) / Bumpless::rise_s) * 3.1416 / (2.0 * rate_hz);
            CHECK (steepest <= 6.2832 * frequency / rate_hz + fade);   // of the wave and of the fade
        }
}

TEST_CASE ("no force of a fade is longer than that of before and that of the new plan, so a ceiling of the mix holds", "[engine]")
{
    constexpr double rate_hz = 4000.0, turn = 6.283185307 * 50.0 / rate_hz;   // of the new force, per tick
    for (const double start : { 0.0, 1.0, 2.5, 4.0 })
    {
        Bumpless bumpless;
        bumpless.prepare (1.0 / rate_hz);
        const Vec3 first { 0.0, 0.6, 0.8 };   // 1 N
        Vec3 last = first;
        bumpless (Effort { .force = first, .torque = 0.1 * first });
        bumpless.begin (false);
        for (int k = 0; k < 1000; ++k)
        {
            const Vec3 wanted { std::cos (start + turn * k), 0.0, std::sin (start + turn * k) };
            const auto passed = bumpless (Effort { .force = wanted, .torque = 0.1 * wanted });
            CHECK (passed.force.norm() <= 1.0 + 1e-12);
            CHECK (passed.torque.norm() <= 0.1 + 1e-12);
            CHECK ((passed.force - last).norm() <= 2.0 * turn + 2.0 * 3.1416 / (2.0 * Bumpless::rise_s * rate_hz));   // of the wave and of the fade
            last = passed.force;
        }
    }
}

TEST_CASE ("edits with new nodes that come all the time hold the effort for at most half of the time", "[engine]")
{
    constexpr double rate_hz = 4000.0;
    for (const int every : { 1, 4, 19, 21, 40, 50 })
    {
        INFO ("an edit every " << every << " ticks");
        Bumpless bumpless;
        bumpless.prepare (1.0 / rate_hz);
        int held = 0, longest = 0, now_held = 0;
        double before = -1.0;
        for (int k = 0; k < 4000; ++k)
        {
            if (k % every == 0) bumpless.begin (true);
            const double force = bumpless (Effort { .force = { 1e-3 * k, 0.0, 0.0 } }).force.x();
            now_held = force == before ? now_held + 1 : 0;
            held += force == before;
            longest = std::max (longest, now_held);
            before = force;
        }
        if (every > 1) CHECK (held <= 2200);   // an edit on each tick also held it before nodes had to settle
        if (every > 1) CHECK (longest <= 25);
    }
}
