// SPDX-License-Identifier: MIT
#include <tactus/nodes/vibration/modal.hpp>

#include <golden/golden.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <random>
#include <utility>
#include <vector>

using tactus::nodes::Modal;
using tactus::test::Golden;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Modal modal (const std::vector<Modal::Mode>& modes, double rate_hz = 4000.0, const Modal::Params& params = {})
{
    Modal node;
    node.params = params;
    node.settings.modes = modes;
    node.prepare ({ .rate_hz = rate_hz });
    return node;
}

double ring (const Modal::Mode& m, double v, double t) { return m.amplitude * v * std::exp (-m.decay * t) * std::sin (2.0 * M_PI * m.frequency * t); }

const std::vector<Modal::Mode> wood { { 100, 80, 1.5 }, { 430, 120, 0.7 }, { 1210, 300, 0.2 } };
}   // namespace

TEST_CASE ("modal: it matches the golden column", "[nodes][vibration][golden]")
{
    const Golden golden ("modal");
    // The golden set gives modes as (a, b, omega): 1, -80, 2 pi 100 and 0.4, -30, 2 pi 230.
    auto node = modal ({ { 100.0, 80.0, 1.0 }, { 1445.132620651305 / (2.0 * M_PI), 30.0, 0.4 } }, 1.0 / golden.dt_s());
    CHECK (golden.worst ("y_modal", [&] (std::size_t i) { return node.tick ({ .hit = golden (i, "hit_v") }).value; })
           <= 1.0);
}

TEST_CASE ("modal: frequency and decay are as set, at any rate", "[nodes][vibration]")
{
    for (const double rate : { 1000.0, 4000.0, 48'000.0 })
    {
        const Modal::Mode mode { 180.0, 40.0, 0.5 };
        auto node = modal ({ mode }, rate);
        CHECK (node.tick ({ .hit = 0.8 }).value == 0.0);
        for (int k = 1; k < int (0.2 * rate); ++k)
            REQUIRE (node.tick ({}).value == Approx (ring (mode, 0.8, k / rate)).margin (1e-13));
    }
}

TEST_CASE ("modal: hits add up exactly, and none makes a click", "[nodes][vibration]")
{
    auto first = modal (wood), second = modal (wood), both = modal (wood);
    for (int k = 0; k < 4000; ++k)
    {
        const double a = k == 3 ? 0.4 : 0.0, b = k == 40 || k == 41 ? 0.9 : 0.0;
        const double sum = first.tick ({ .hit = a }).value + second.tick ({ .hit = b }).value;
        const double together = both.tick ({ .hit = a + b }).value;
        REQUIRE (together == Approx (sum).margin (1e-15));
    }

    tactus::test::property ("any modes, any number of hits: the sum of the closed forms", [] (unsigned seed) {
        std::mt19937 random { seed };
        const auto uniform = [&] (double from, double to) { return std::uniform_real_distribution { from, to }(random); };

        const double rate = uniform (1000.0, 20'000.0);
        std::vector<Modal::Mode> modes (1 + random() % 6);
        double loudest = 0.0;
        for (auto& mode : modes)
        {
            mode = { uniform (1.0, 0.49 * rate), uniform (1.0, 500.0), uniform (-2.0, 2.0) };
            loudest += std::abs (mode.amplitude);
        }
        std::vector<std::pair<int, double>> hits (1 + random() % 8);   // tick and speed
        for (auto& [tick, v] : hits)
            tick = static_cast<int> (random() % 300), v = uniform (0.0, 2.0);

        auto node = modal (modes, rate);
        for (int k = 0; k < 600; ++k)
        {
            double hit = 0.0, sum = 0.0;
            for (const auto& [tick, v] : hits)
            {
                if (tick == k) hit += v;
                if (tick > k) continue;
                for (const auto& mode : modes)
                    sum += ring (mode, v, (k - tick) / rate);
            }
            RC_ASSERT (std::abs (node.tick ({ .hit = hit }).value - sum) <= 1e-11 * loudest);
        }
    });

    // On the tick of a hit, the output is bit-identical to the output without the hit.
    auto struck = modal (wood), left = modal (wood);
    struck.tick ({ .hit = 1.0 });
    left.tick ({ .hit = 1.0 });
    for (int k = 0; k < 20; ++k)
        CHECK (struck.tick ({}).value == left.tick ({}).value);
    CHECK (struck.tick ({ .hit = 5.0 }).value == left.tick ({}).value);
}

TEST_CASE ("modal: pitch, damping and gain multiply", "[nodes][vibration]")
{
    auto bent = modal ({ { 100.0, 40.0, 0.5 } }, 4000.0, { .gain = 3.0, .pitch = 1.5, .damping = 2.0 });
    bent.tick ({ .hit = 1.0 });
    for (int k = 1; k < 400; ++k)
        REQUIRE (bent.tick ({}).value == Approx (3.0 * ring ({ 150.0, 80.0, 0.5 }, 1.0, k / 4000.0)).margin (1e-13));
}

TEST_CASE ("modal: bending the pitch of a ring makes no step", "[nodes][vibration]")
{
    auto node = modal ({ { 100.0, 20.0, 1.0 } });
    double before = node.tick ({ .hit = 1.0 }).value;
    for (int k = 0; k < 400; ++k)
    {
        node.params.pitch = k % 2 == 0 ? 2.0 : 0.5;
        node.update();
        const double now = node.tick ({}).value;
        REQUIRE (std::abs (now - before) < 2.0 * M_PI * 200.0 / 4000.0 * 1.1);
        before = now;
    }
}

TEST_CASE ("modal: modes above half the rate, and modes that do not decay, are silent", "[nodes][vibration]")
{
    auto node = modal ({ { 500.0, 10.0, 1.0 }, { 1700.0, 10.0, 1.0 }, { 100.0, 0.0, 1.0 } }, 1000.0);
    node.tick ({ .hit = 1.0 });
    for (int k = 0; k < 100; ++k)
        CHECK (node.tick ({}).value == 0.0);

    auto high = modal ({ { 450.0, 10.0, 1.0 } }, 1000.0, { .pitch = 1.2 });
    high.tick ({ .hit = 1.0 });
    CHECK (high.tick ({}).value == 0.0);
    high.params.pitch = 1.0;   // back in the band, the mode does not ring from an earlier hit
    high.update();
    CHECK (high.tick ({}).value == 0.0);
    high.tick ({ .hit = 1.0 });
    CHECK (high.tick ({}).value != 0.0);
}

TEST_CASE ("modal: an input that is not a hit is ignored, and the ring continues", "[nodes][vibration]")
{
    auto node = modal (wood), undisturbed = modal (wood);
    node.tick ({ .hit = 1.0 });
    undisturbed.tick ({ .hit = 1.0 });
    for (const double v : { -1.0, 0.0, not_a_number, tactus::inf, -tactus::inf })
        CHECK (node.tick ({ .hit = v }).value == undisturbed.tick ({}).value);
}

TEST_CASE ("modal: a ring ends in exact silence", "[nodes][vibration]")
{
    auto node = modal (wood);
    node.tick ({ .hit = 1.0 });
    for (int k = 0; k < 10'000; ++k)
        node.tick ({});
    CHECK (node.tick ({}).value == 0.0);
}

TEST_CASE ("modal: the other modes keep ringing when a mode is added", "[nodes][vibration]")
{
    auto old = modal (wood), undisturbed = modal (wood);
    old.tick ({ .hit = 1.0 });
    undisturbed.tick ({ .hit = 1.0 });
    for (int k = 0; k < 30; ++k)
    {
        old.tick ({});
        undisturbed.tick ({});
    }

    // The new mode comes first, so that every index changes; and one mode occurs twice.
    auto next = modal ({ { 60, 50, 1.0 }, wood[0], wood[1], wood[2], wood[2] });
    next.adopt (old);
    for (int k = 0; k < 100; ++k)
        CHECK (next.tick ({}).value == Approx (undisturbed.tick ({}).value).margin (1e-15));
}

TEST_CASE ("modal: no input breaks it", "[nodes][vibration]")
{
    tactus::test::property ("the output is finite", [] {
        const double gain = *rc::gen::element (0.0, 1.0, -1e300), pitch = *rc::gen::element (0.0, 1.0, 1e300),
                     damping = *rc::gen::element (0.0, 1.0, 1e300);
        auto node = modal (wood, 4000.0, { .gain = gain, .pitch = pitch, .damping = damping });
        for (int k = 0; k < 60; ++k)
        {
            const double hit = *rc::gen::element (0.0, 1.0, -1.0, 1e300, 1.7e308, 1e-320, not_a_number, tactus::inf);
            RC_ASSERT (tactus::isFinite (node.tick ({ .hit = hit }).value));
        }
    });
}
