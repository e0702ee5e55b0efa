// SPDX-License-Identifier: MIT
// The sums of wires: networks that sort, and records that add up a vector.

#include "support/sketch.hpp"

#include <support/property.hpp>
#include <tactus/plan/steps/sum_step.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace tactus;

namespace
{
std::uint64_t bits (double v) { return std::bit_cast<std::uint64_t> (v); }

/// The definition: in order of value, and one NaN for all.
double inOrder (std::vector<double> values)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (values.empty()) return 0.0;
    if (std::ranges::any_of (values, [] (double v) { return std::isnan (v); })) return nan;
    std::ranges::stable_sort (values);
    double total = values[0];
    for (std::size_t i = 1; i < values.size(); ++i)
        total += values[i];
    return std::isnan (total) ? nan : total;
}

/// Numbers that sums depend on: of very different sizes, equal, opposite, zeros of both signs, infinities, NaN.
rc::Gen<double> anyNumber()
{
    constexpr double inf = std::numeric_limits<double>::infinity();
    const auto special = rc::gen::element (0.0, -0.0, 1.0, -1.0, 1e-16, 3.0, -3.0, 1e300, -1e300, 5e-324, inf, -inf, std::nan (""), -std::nan ("7"));
    return rc::gen::oneOf (special, rc::gen::arbitrary<double>(), rc::gen::map (rc::gen::inRange (-3, 4), [] (int n) { return 0.1 * n; }));
}
/// The gain of the w-th wire. With gains, it is never 1: a single wire without a gain needs no sum.
double gainOf (std::size_t w, bool with_gains) { return with_gains ? 0.7 + 0.4 * static_cast<double> (w) : 1.0; }
}   // namespace

TEST_CASE ("a sum of wires has the bits of the sum in order of value, whatever the values and their order", "[plan][property]")
{
    test::property ("any values", [] {
        auto values = *rc::gen::container<std::vector<double>> (anyNumber());
        const auto expected = bits (inOrder (values));
        for (int turn = 0; turn < static_cast<int> (values.size()) + 1; ++turn)
        {
            auto scratch = values;
            RC_ASSERT (bits (plan::sum (scratch.data(), static_cast<int> (scratch.size()))) == expected);
            if (! values.empty()) std::rotate (values.begin(), values.begin() + 1, values.end());
            if (turn % 2 == 1) std::ranges::reverse (values);
        }
    });
}

TEST_CASE ("a sum that starts from the order of the last tick has the same bits, however the values move", "[plan][property]")
{
    test::property ("values that creep and jump", [] {
        const auto n = *rc::gen::inRange<std::size_t> (1, 40);
        auto values = *rc::gen::container<std::vector<double>> (n, anyNumber());
        std::vector<plan::Placed> placed;
        for (std::size_t i = 0; i < n; ++i)
            placed.push_back ({ 0.0, static_cast<std::uint32_t> (i) });
        for (int tick = 0; tick < 10; ++tick)
        {
            for (auto& p : placed)
                p.value = values[p.term];
            RC_ASSERT (bits (plan::sumInOrder (placed.data(), n)) == bits (inOrder (values)));
            const auto first = *rc::gen::inRange<std::size_t> (0, n), jumps = *rc::gen::element<std::size_t> (0, 1, n);
            for (auto& v : values)
                v *= 1.01;
            for (std::size_t k = 0; k < jumps; ++k)
                values[(first + k) % n] = *anyNumber();
        }
        std::vector<bool> seen (n);
        for (const auto& p : placed)
            seen[p.term] = true;
        RC_ASSERT (std::ranges::all_of (seen, [] (bool s) { return s; }));
    });
}

TEST_CASE ("every order of three and of four special values has the same sum, to the bit", "[plan]")
{
    constexpr double inf = std::numeric_limits<double>::infinity();
    const double some[] { 0.0, -0.0, 1.0, -1.0, 1e-17, 1e300, inf, -inf, std::nan ("") };
    int wrong = 0, count = 0;
    for (const double a : some)
        for (const double b : some)
            for (const double c : some)
            {
                wrong += bits (plan::sumOf (a, b, c)) != bits (inOrder ({ a, b, c }));
                for (const double d : some)
                {
                    wrong += bits (plan::sumOf (a, b, c, d)) != bits (inOrder ({ a, b, c, d }));
                    ++count;
                }
            }
    CHECK (count == 9 * 9 * 9 * 9);
    CHECK (wrong == 0);
}

TEST_CASE ("the sums of the components of a vector are one record for up to four wires, with the bits of the definition", "[plan]")
{
    const auto with_gains = GENERATE (true, false);
    for (const std::size_t wires : { with_gains ? 1u : 2u, 2u, 3u, 4u, 5u, 7u })
    {
        INFO (wires << " wires" << (with_gains ? " with gains" : ""));
        test::Sketch sketch;
        sketch.node ("motor", "device.force");
        CompileOptions options { .records = { "motor.force" } };
        for (std::size_t w = 0; w < wires; ++w)
        {
            const auto vector = "v" + std::to_string (w);
            sketch.node (vector, "vector.join");
            for (const std::string component : { "x", "y", "z" })
            {
                const auto noise = vector + component;
                sketch.node (noise, "signal.noise", Json::object(), { { "seed", sketch.graph.root.nodes.size() } });
                sketch.wire (noise + ".out -> " + vector + "." + component);
            }
            sketch.wire (vector + ".out -> motor.force");
            sketch.graph.root.wires.back().gain = gainOf (w, with_gains);
            options.records.push_back (vector + ".out");
        }
        const auto plan = sketch.compile (options).plan;
        REQUIRE (plan);

        std::vector<int> sums;   // of each record that has any
        for (const auto& record : plan->records())
        {
            int count = 0;
            plan::eachSum (record, [&] (const plan::Sum& sum) { count += sum.terms.size() == wires; });
            if (count > 0) sums.push_back (count);
        }
        CHECK (sums == (wires <= 4 ? std::vector<int> { 3 } : std::vector<int> { 1, 1, 1 }));

        int wrong = 0;
        for (int k = 0; k < 100; ++k)
        {
            plan->tick();
            for (std::size_t c = 0; c < 3; ++c)
            {
                std::vector<double> terms;
                for (std::size_t w = 0; w < wires; ++w)
                    terms.push_back (gainOf (w, with_gains) * *plan->taps()[3 * (w + 1) + c].value);
                wrong += bits (*plan->taps()[c].value) != bits (inOrder (terms));
            }
        }
        CHECK (wrong == 0);
    }
}
