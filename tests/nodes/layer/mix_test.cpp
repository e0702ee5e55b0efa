// SPDX-License-Identifier: MIT
#include <tactus/nodes/layer/mix.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using tactus::nodes::LayerMix;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double T = 1e-3;

/// A desk with wired layers.
class Desk
{
public:
    explicit Desk (int inputs, const LayerMix::Params& params = {})
    {
        node.settings.inputs = inputs;
        node.params = params;
        node.prepare ({ .rate_hz = 1.0 / T });
        node.update();
    }

    LayerMix::Outputs mix (const std::vector<double>& layers)
    {
        std::vector<const double*> sources;
        for (const double& v : layers)
            sources.push_back (&v);
        return node.tick ({ .in = { sources.data(), static_cast<int> (layers.size()) } });
    }

    LayerMix::Outputs mix (const std::vector<double>& layers, int ticks)
    {
        for (int k = 1; k < ticks; ++k)
            mix (layers);
        return mix (layers);
    }

    template <typename F>
    void change (F edit)
    {
        edit (node.params);
        node.update();
    }

    LayerMix node;
};

template <typename F>
LayerMix::Params params (F edit)
{
    LayerMix::Params p;
    edit (p);
    return p;
}
}   // namespace

TEST_CASE ("layer: by default it adds", "[nodes][layer]")
{
    Desk desk { 3 };
    CHECK (desk.mix ({ 1.0, 10.0, -100.0 }).out == -89.0);
    CHECK (desk.mix ({ 1.0, 10.0, -100.0 }).reduction == 0.0);
}

TEST_CASE ("layer: each layer has its own gain", "[nodes][layer]")
{
    Desk desk { 2, params ([] (auto& p) { p.gain[1] = 0.5; }) };
    const auto out = desk.mix ({ 1.0, 10.0 });
    CHECK (out.out == 6.0);
    CHECK (out.level[0] == 1.0);
    CHECK (out.level[1] == 5.0);
}

TEST_CASE ("layer: a layer that is muted from the start is never heard", "[nodes][layer]")
{
    Desk desk { 2, params ([] (auto& p) { p.mute[0] = 1.0; }) };
    const auto out = desk.mix ({ 5.0, 0.25 });
    CHECK (out.out == 0.25);
    CHECK (out.level[0] == 0.0);
}

TEST_CASE ("layer: a solo silences the other layers, and mute wins over solo", "[nodes][layer]")
{
    Desk desk { 3, params ([] (auto& p) { p.solo[1] = 1.0; }) };
    CHECK (desk.mix ({ 1.0, 10.0, 100.0 }).out == 10.0);
    desk.change ([] (auto& p) { p.solo[2] = 1.0; });
    CHECK (desk.mix ({ 1.0, 10.0, 100.0 }, 20).out == 110.0);
    desk.change ([] (auto& p) { p.mute[1] = 1.0; });
    CHECK (desk.mix ({ 1.0, 10.0, 100.0 }, 20).out == 100.0);
    desk.change ([] (auto& p) { p.solo[1] = p.solo[2] = p.mute[1] = 0.0; });
    CHECK (desk.mix ({ 1.0, 10.0, 100.0 }, 20).out == 111.0);
}

TEST_CASE ("layer: mute and solo do not click", "[nodes][layer]")
{
    Desk desk { 2 };
    double before = desk.mix ({ 1.0, 1.0 }).out;
    const auto steps = [&] (auto edit) {
        desk.change (edit);
        double largest = 0.0;
        for (int k = 0; k < 20; ++k)
        {
            const double out = desk.mix ({ 1.0, 1.0 }).out;
            largest = std::max (largest, std::abs (out - before));
            before = out;
        }
        return largest;
    };
    CHECK (steps ([] (auto& p) { p.mute[0] = 1.0; })
           == Approx (T / 10e-3));
    CHECK (before == 1.0);
    CHECK (steps ([] (auto& p) { p.mute[0] = 0.0; })
           == Approx (T / 10e-3));
    CHECK (before == 2.0);
    CHECK (steps ([] (auto& p) { p.solo[0] = 1.0; })
           == Approx (T / 10e-3));
    CHECK (before == 1.0);
}

TEST_CASE ("layer: a layer ducks those of lower priority while it sounds, by duck_db", "[nodes][layer]")
{
    Desk desk { 3, params ([] (auto& p) { p.priority[0] = 2.0;
                             p.priority[1] = p.priority[2] = 1.0;
                             p.duck_db = 20.0; }) };
    CHECK (desk.mix ({ 0.0, 1.0, 2.0 }, 200).out == 3.0);   // equal priorities do not duck each other
    CHECK (desk.mix ({ 10.0, 1.0, 2.0 }, 200).out == Approx (10.3));
    CHECK (desk.mix ({ 10.0, 1.0, 2.0 }).level[1] == 1.0);   // the level is measured before ducking
    CHECK (desk.mix ({ 0.0, 1.0, 2.0 }, 3000).out == 3.0);   // bit for bit
}

TEST_CASE ("layer: it ducks once, however many layers sound", "[nodes][layer]")
{
    Desk desk { 3, params ([] (auto& p) { p.priority[0] = 3.0;
                             p.priority[1] = 2.0;
                             p.duck_db = 20.0; }) };
    CHECK (desk.mix ({ 1.0, 1.0, 1.0 }, 200).out == Approx (1.2));
}

TEST_CASE ("layer: a muted layer ducks no other layer", "[nodes][layer]")
{
    Desk desk { 2, params ([] (auto& p) { p.priority[0] = 1.0;
                             p.mute[0] = 1.0; }) };
    CHECK (desk.mix ({ 5.0, 1.0 }, 100).out == 1.0);
}

TEST_CASE ("layer: ducking starts fast, ends slowly, and does not click", "[nodes][layer]")
{
    Desk desk { 2, params ([] (auto& p) { p.priority[0] = 1.0;
                             p.duck_db = 200.0; }) };
    desk.mix ({ 0.0, 1.0 });
    double d = 1.0;
    for (int k = 1; k <= 5; ++k)
    {
        const double now = desk.mix ({ 10.0, 1.0 }).out - 10.0;
        CHECK (now < d);
        CHECK (d - now < 0.2);
        d = now;
    }
    CHECK (d == Approx (std::exp (-1.0)).epsilon (1e-6));   // after 5 ms

    desk.mix ({ 10.0, 1.0 }, 500);
    int ticks = 0;
    while (desk.mix ({ 0.0, 1.0 }).out < 0.5)
        ++ticks;
    CHECK (ticks > 69);   // after the higher layer falls silent, the lower one takes 69 ms to return halfway
    CHECK (ticks < 400);
}

TEST_CASE ("layer: a layer that begins long after another has ended starts at full strength", "[nodes][layer]")
{
    Desk desk { 2, params ([] (auto& p) { p.priority[0] = 1.0; }) };
    desk.mix ({ 3.0, 0.0 }, 100);
    desk.mix ({ 0.0, 0.0 }, 3000);
    CHECK (desk.mix ({ 0.0, 1.0 }).out == 1.0);
}

TEST_CASE ("layer: the level rises immediately and decays over 50 ms", "[nodes][layer]")
{
    Desk desk { 2 };
    CHECK (desk.mix ({ -2.0, 0.0 }).level[0] == 2.0);
    CHECK (desk.mix ({ 0.0, 0.0 }, 50).level[0] == Approx (2.0 * std::exp (-1.0)));
    CHECK (desk.mix ({ 0.0, 0.0 }, 100'000).level[0] == 0.0);
}

TEST_CASE ("layer: the ceiling is never exceeded, and below it nothing changes", "[nodes][layer]")
{
    tactus::test::property ("any layers", [] {
        const double ceiling = *rc::gen::element (0.5, 2.0, 20.0);
        Desk desk { 3, params ([&] (auto& p) { p.ceiling = ceiling; }) };
        Desk open { 3 };
        for (int k = 0; k < 20; ++k)
        {
            const int a = *rc::gen::inRange (-1000, 1000), b = *rc::gen::inRange (-1000, 1000), c = *rc::gen::inRange (-1000, 1000);
            const std::vector<double> layers { 0.01 * a, 0.01 * b, 0.01 * c };
            const auto out = desk.mix (layers);
            const double sum = open.mix (layers).out;
            RC_ASSERT (std::abs (out.out) <= ceiling);
            RC_ASSERT (out.out == std::clamp (sum, -ceiling, ceiling));
            RC_ASSERT (out.reduction >= 0.0);
            RC_ASSERT ((out.reduction > 0.0) == (out.out != sum));
        }
    });

    Desk desk { 2, params ([] (auto& p) { p.ceiling = 2.0; }) };
    CHECK (desk.mix ({ -10.0, -10.0 }).out == -2.0);
    CHECK (desk.mix ({ -10.0, -10.0 }).reduction == Approx (20.0));
}

TEST_CASE ("layer: a ceiling that is set or taken away fades in 10 ms", "[nodes][layer]")
{
    Desk desk { 1, params ([] (auto& p) { p.ceiling = 0.5; }) };
    double before = desk.mix ({ 2.5 }).out;
    REQUIRE (before == 0.5);
    for (const double ceiling : { 0.0, 0.5 })
    {
        desk.change ([&] (auto& p) { p.ceiling = ceiling; });
        const double way = ceiling == 0.0 ? 2.0 : -2.0;
        for (int k = 1; k <= 10; ++k)
        {
            const auto mixed = desk.mix ({ 2.5 });
            CHECK (mixed.out - before == Approx (way * T / 10e-3));
            CHECK (mixed.reduction == Approx (20.0 * std::log10 (2.5 / mixed.out)).margin (1e-9));
            before = mixed.out;
        }
        CHECK (before == Approx (ceiling == 0.0 ? 2.5 : 0.5));
        CHECK (desk.mix ({ 2.5 }).out == (ceiling == 0.0 ? 2.5 : 0.5));
    }
}

TEST_CASE ("layer: another ceiling before the last one has faded makes no step", "[nodes][layer]")
{
    for (const int later : { 1, 5, 9 })
        for (const double next : { 0.25, 5.0, 20.0 })
        {
            Desk desk { 1, params ([] (auto& p) { p.ceiling = 0.5; }) };
            double before = desk.mix ({ 10.0 }).out;
            const auto follow = [&] (double ceiling, int ticks) {
                desk.change ([&] (auto& p) { p.ceiling = ceiling; });
                for (int k = 0; k < ticks; ++k)
                {
                    const double out = desk.mix ({ 10.0 }).out;
                    CHECK (std::abs (out - before) <= (10.0 + std::max (0.5, next)) * T / 10e-3 + 1e-9);
                    before = out;
                }
            };
            follow (0.0, later);
            follow (next, 10);
            CHECK (before == Approx (std::min (10.0, next)));
        }
}

TEST_CASE ("layer: a ceiling that comes holds after 10 ms, and one that the force does not reach changes nothing", "[nodes][layer]")
{
    const double earlier = GENERATE (0.0, 0.5, 20.0, 100.0), force = GENERATE (4.9, 30.0), next = GENERATE (0.1, 0.5, 5.0);
    const int without = GENERATE (0, 1, 5, 9, 10, 30);   // ticks
    Desk desk { 1, params ([&] (auto& p) { p.ceiling = earlier; }) };
    const auto after = [&] (double ceiling, int ticks) {
        desk.change ([&] (auto& p) { p.ceiling = ceiling; });
        double out = 0.0;
        for (int k = 0; k < ticks; ++k)
        {
            out = desk.mix ({ force }).out;
            if ((earlier == 0.0 || force < earlier) && force < next) CHECK (out == force);
        }
        return out;
    };
    after (earlier, 3);
    if (without > 0) after (0.0, without);
    CHECK (after (next, 10) == Approx (std::min (force, next)));
    CHECK (after (next, 1) == std::min (force, next));
}

TEST_CASE ("layer: it mixes millinewtons as well as newtons", "[nodes][layer]")
{
    tactus::test::property ("a thousandth in, a thousandth out", [] {
        const auto priorities = params ([] (auto& p) { p.priority[1] = 1.0; });
        Desk large { 2, priorities }, small { 2, priorities };
        for (int k = 0; k < 200; ++k)
        {
            const int a = *rc::gen::inRange (-100, 100), b = *rc::gen::element (0, 0, 0, 50);
            const double out = large.mix ({ 1.0 * a, 1.0 * b }).out;
            RC_ASSERT (std::abs (small.mix ({ 1e-3 * a, 1e-3 * b }).out - 1e-3 * out) <= 1e-12);
        }
    });
}

TEST_CASE ("layer: a fault silences everything, and the next sample counts as the first", "[nodes][layer]")
{
    for (const double bad : { not_a_number, tactus::inf, -tactus::inf })
    {
        Desk desk { 2, params ([] (auto& p) { p.priority[0] = 1.0; }) };
        desk.mix ({ 1.0, 1.0 }, 100);
        desk.change ([] (auto& p) { p.mute[0] = 1.0; });
        const auto out = desk.mix ({ bad, 1.0 });
        CHECK (out.out == 0.0);
        CHECK (out.level[1] == 0.0);
        CHECK (out.reduction == 0.0);
        CHECK (desk.mix ({ 1.0, 1.0 }).out == 1.0);   // muted and not ducked, without ramps
    }
}

TEST_CASE ("layer: no input breaks it", "[nodes][layer]")
{
    tactus::test::property ("outputs are finite", [] {
        const auto number = rc::gen::element (0.0, 1.0, -1.0, 1e-320, -1e160, 1e300, -1.7e308, 1.7e308, not_a_number, tactus::inf);
        const auto param = rc::gen::element (0.0, 1.0, -2.0, 1e300);
        LayerMix::Params p;
        for (int i = 0; i < 3; ++i)
        {
            p.gain[i] = *param;
            p.priority[i] = *param;
            p.mute[i] = *rc::gen::element (0.0, 1.0);
        }
        p.duck_db = *rc::gen::element (0.0, 12.0, 1e300);
        p.ceiling = *rc::gen::element (0.0, 1e-320, 1.0, 1e300);
        Desk desk { 3, p };
        for (int k = 0; k < 20; ++k)
        {
            const double a = *number, b = *number, c = *number;
            const auto out = desk.mix ({ a, b, c });
            RC_ASSERT (tactus::isFinite (out.out, out.reduction, out.level[0], out.level[1], out.level[2]));
        }
    });
}

TEST_CASE ("layer: a new instance keeps ducking", "[nodes][layer]")
{
    const auto priorities = params ([] (auto& p) { p.priority[0] = 1.0; });
    Desk old { 2, priorities }, next { 2, priorities };
    old.mix ({ 1.0, 1.0 }, 100);
    next.node.adopt (old.node);
    CHECK (next.mix ({ 0.0, 1.0 }).out == old.mix ({ 0.0, 1.0 }).out);
}
