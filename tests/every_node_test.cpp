// SPDX-License-Identifier: MIT
// What every node promises. These tests cover a new node too, even if it has no test of its own.

#include "support/no_allocation.hpp"
#include "support/node_dice.hpp"
#include "support/rig.hpp"

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <sstream>

using namespace tactus;
using namespace tactus::test;
using Dice = NodeDice;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <typename... T>
void fail (const T&... words)
{
    std::ostringstream text;
    (text << ... << words);
    RC_FAIL (text.str());
}

void checkFinite (const Rig& rig)
{
    for (std::size_t i = 0; i < rig.outputs.size(); ++i)
        if (! std::isfinite (rig.out (i)))
        {
            std::ostringstream inputs;
            for (const double v : rig.in)
                inputs << ' ' << v;
            fail (rig.outputs[i].port->id, " is ", rig.out (i), " for inputs", inputs.str());
        }
}

bool sameBits (const std::vector<double>& a, const std::vector<double>& b)
{
    return std::ranges::equal (
        a, b, {}, [] (double v) { return std::bit_cast<std::uint64_t> (v); },
        [] (double v) { return std::bit_cast<std::uint64_t> (v); });
}

/// The value of an output on a fault: -1 for states and triangles, the previous value for what a material remembers, otherwise 0.
double onFault (std::string_view type, std::string_view output, double before)
{
    if (output == "state" || output == "triangle") return -1.0;
    if (output == "dissipated_energy" || output == "crack" || output == "crack_front") return before;
    if (type == "safety.passivity" && output == "energy") return before;
    return 0.0;
}

std::vector<double> onFault (const Rig& rig, const std::vector<double>& before)
{
    std::vector<double> expected;
    for (std::size_t i = 0; i < rig.outputs.size(); ++i)
        expected.push_back (onFault (rig.type().info.id, rig.outputs[i].port->id, before[i]));
    return expected;
}

/// A closed path of random size and shape.
class TangledLoop
{
public:
    static constexpr int steps = 5000;

    explicit TangledLoop (Dice& dice)
    {
        const double size = std::pow (10.0, dice.uniform (-5.0, -2.0));
        for (int w = 0; w < waves; ++w)
            for (int i = 0; i < 3; ++i)
            {
                sines[w][i] = dice.uniform (-size, size);
                cosines[w][i] = dice.uniform (-size, size);
            }
    }

    Vec3 operator() (int k) const
    {
        Vec3 p = Vec3::Zero();
        for (int w = 0; w < waves; ++w)
        {
            const double angle = 2.0 * M_PI * (w + 1) * (k % steps) / steps;
            p += std::sin (angle) * sines[w] + std::cos (angle) * cosines[w];
        }
        return p;
    }

private:
    static constexpr int waves = 4;
    Vec3 sines[waves], cosines[waves];
};

bool isHit (const PortSheet& port) { return port.unit.kind == UnitRule::Kind::fixed && port.unit.unit.quantity == Quantity::hit; }

Rig prepared (const NodeType& type, double rate_hz = 4000.0)
{
    Rig rig { type, rate_hz };
    rig.prepare();
    return rig;
}
}   // namespace

TEST_CASE ("every node gives finite outputs for finite inputs", "[nodes][contract]")
{
    for (const auto& type : catalogue())
        DYNAMIC_SECTION (type.info.id)
        {
            rc::prop ("any inputs, params over the usual or the whole range", [&] (unsigned seed) {
                Dice dice { seed };
                static constexpr double rates[] { 100.0, 1000.0, 4000.0, 48000.0 };
                Rig rig { type, rates[dice.below (4)] };
                if (dice.once_in (2)) randomSettings (rig, dice);
                if (! dice.once_in (4)) randomParams (rig, dice, dice.once_in (2) ? Span::usual : Span::hard);
                rig.prepare();

                const double size = dice.size();
                for (int k = 0; k < 100; ++k)
                {
                    if (dice.once_in (20)) randomParams (rig, dice, dice.once_in (2) ? Span::usual : Span::hard);
                    randomInputs (rig, dice, size);
                    rig.tick();
                    checkFinite (rig);
                }
            });
        }
}

TEST_CASE ("every node answers a non-finite input with 0 and goes on", "[nodes][contract]")
{
    for (const auto& type : catalogue())
        DYNAMIC_SECTION (type.info.id)
        {
            rc::prop ("nan or inf in any one component", [&] (unsigned seed) {
                Dice dice { seed };
                Rig rig = prepared (type), twin = prepared (type);
                if (rig.in.empty()) return;

                for (int k = 0; k < 20; ++k)
                {
                    randomTameInputs (rig, dice);
                    twin.in = rig.in;
                    rig.tick();
                    twin.tick();
                }
                const auto before = rig.outs();

                const auto at = static_cast<std::size_t> (dice.below (static_cast<int> (rig.in.size())));
                const auto& port = *rig.inputs[at].port;
                const bool nan_is_unwired = std::isnan (port.initial[0]);
                static constexpr double bad[] { inf, -inf, not_a_number };
                rig.in[at] = bad[dice.below (nan_is_unwired ? 2 : 3)];
                twin.in[at] = 0.0;
                rig.tick();
                twin.tick();
                if (type.peek)   // a node with peek() gives its outputs before it reads the inputs, so the fault shows one tick later
                {
                    randomTameInputs (rig, dice);
                    rig.in[at] = 0.0;
                    rig.tick();
                    twin.tick();
                }

                // a hit that is not finite may simply not count as a hit
                if (! (isHit (port) && sameBits (rig.outs(), twin.outs())))
                    for (std::size_t i = 0; i < rig.outputs.size(); ++i)
                    {
                        const auto& output = *rig.outputs[i].port;
                        if (rig.out (i) != onFault (rig, before)[i])
                            fail (port.id, " is not finite, but ", output.id, " is ", rig.out (i));
                    }

                for (int k = 0; k < 20; ++k)
                {
                    randomTameInputs (rig, dice);
                    if (! std::isfinite (rig.in[at])) rig.in[at] = 0.0;
                    rig.tick();
                    checkFinite (rig);
                }
            });
        }
}

TEST_CASE ("every node works again after a fault", "[nodes][contract]")
{
    for (const auto& type : catalogue())
    {
        if (type.inputs.empty()) continue;
        DYNAMIC_SECTION (type.info.id)
        {
            // If an output is ever nonzero on a node without a fault, it must also become nonzero on a node after a fault.
            std::vector<char> lives, lives_on;
            Dice dice { 1 };
            for (int trial = 0; trial < 50; ++trial)
            {
                Rig rig = prepared (type), twin = prepared (type);
                lives.resize (rig.outputs.size());
                lives_on.resize (rig.outputs.size());
                const auto at = static_cast<std::size_t> (dice.below (static_cast<int> (rig.in.size())));
                for (int k = 0; k < 40; ++k)
                {
                    randomTameInputs (rig, dice);
                    twin.in = rig.in;
                    if (k == 20) rig.in[at] = inf;
                    rig.tick();
                    twin.tick();
                    rig.in = twin.in;
                    for (std::size_t i = 0; k > 20 && i < rig.outputs.size(); ++i)
                    {
                        lives[i] |= twin.out (i) != 0.0;
                        lives_on[i] |= rig.out (i) != 0.0;
                    }
                }
            }
            CHECK (lives == lives_on);
        }
    }
}

TEST_CASE ("a node without a memory does not remember a fault", "[nodes][contract]")
{
    for (const auto& type : catalogue())
    {
        if (type.peek) continue;
        DYNAMIC_SECTION (type.info.id)
        {
            // A node has no memory if it always answers like a fresh one, whatever its past.
            const auto answers = [&] (Dice& dice, bool with_fault) {
                Rig old = prepared (type), fresh = prepared (type);
                for (int k = 0; k < 10; ++k)
                {
                    randomTameInputs (old, dice);
                    old.tick();
                }
                if (with_fault && ! old.in.empty())
                {
                    old.in[static_cast<std::size_t> (dice.below (static_cast<int> (old.in.size())))] = not_a_number;
                    old.tick();
                }
                for (auto& v : old.in)
                    v = dice.uniform (-1.0, 1.0);
                fresh.in = old.in;
                old.tick();
                fresh.tick();
                return sameBits (old.outs(), fresh.outs());
            };

            Dice dice { 1 };
            bool remembers = false;
            for (int k = 0; k < 50; ++k)
                remembers = remembers || ! answers (dice, false);
            if (! remembers)
                for (int k = 0; k < 50; ++k)
                    CHECK (answers (dice, true));
        }
    }
}

TEST_CASE ("every node repeats itself to the bit", "[nodes][contract]")
{
    for (const auto& type : catalogue())
        DYNAMIC_SECTION (type.info.id)
        {
            rc::prop ("two fresh instances, the same inputs", [&] (unsigned seed) {
                const auto run = [&] {
                    Dice dice { seed };
                    Rig rig { type };
                    randomSettings (rig, dice);
                    randomParams (rig, dice, Span::usual);
                    rig.prepare();
                    std::vector<double> all;
                    for (int k = 0; k < 50; ++k)
                    {
                        randomTameInputs (rig, dice);
                        rig.tick();
                        for (std::size_t i = 0; i < rig.outputs.size(); ++i)
                            all.push_back (rig.out (i));
                    }
                    return all;
                };
                RC_ASSERT (sameBits (run(), run()));
            });
        }
}

TEST_CASE ("every node that can adopt goes on exactly where the old instance was", "[nodes][contract]")
{
    for (const auto& type : catalogue())
    {
        if (! type.adopt) continue;
        DYNAMIC_SECTION (type.info.id)
        {
            rc::prop ("same settings, same params", [&] (unsigned seed) {
                Dice dice { seed };
                Rig old = prepared (type), young = prepared (type);
                for (int k = 0; k < 50; ++k)
                {
                    randomTameInputs (old, dice);
                    old.tick();
                }
                young.adopt (old);
                for (int k = 0; k < 50; ++k)
                {
                    randomTameInputs (old, dice);
                    young.in = old.in;
                    old.tick();
                    young.tick();
                    RC_ASSERT (sameBits (old.outs(), young.outs()));
                }
            });
        }
    }
}

TEST_CASE ("no node allocates or locks within a tick", "[nodes][contract]")
{
    if (! NoAllocation::watches)
    {
        WARN ("allocations are not watched under this sanitizer");
        return;
    }

    for (const auto& type : catalogue())
        DYNAMIC_SECTION (type.info.id)
        {
            Dice dice { 1 };
            Rig rig = prepared (type);
            for (int k = 0; k < 200; ++k)
            {
                if (k % 20 == 0) randomParams (rig, dice, Span::usual);
                randomTameInputs (rig, dice);
                if (k == 100 && ! rig.in.empty()) rig.in[0] = not_a_number;

                int allocations = 0, locks = 0;
                {
                    const NoAllocation watch;
                    rig.moved();
                    rig.tick();
                    rig.effort();
                    allocations = watch.allocations();
                    locks = watch.locks();
                }
                REQUIRE (allocations == 0);
                REQUIRE (locks == 0);
            }
        }
}

TEST_CASE ("a node that claims an amplitude never exceeds it", "[nodes][contract]")
{
    for (const auto& type : catalogue())
    {
        if (! type.claims) continue;
        DYNAMIC_SECTION (type.info.id)
        {
            rc::prop ("any inputs", [&] (unsigned seed) {
                Dice dice { seed };
                Rig rig { type };
                if (dice.once_in (2)) randomSettings (rig, dice);
                if (! dice.once_in (4)) randomParams (rig, dice, dice.once_in (2) ? Span::usual : Span::hard);
                rig.prepare();

                const double amplitude = rig.claims().amplitude;
                if (! std::isfinite (amplitude)) return;

                const double size = dice.size();
                for (int k = 0; k < 100; ++k)
                {
                    randomInputs (rig, dice, size);
                    rig.tick();
                    for (std::size_t i = 0; i < rig.outputs.size(); ++i)
                    {
                        const auto& [port, index] = rig.outputs[i];
                        if (port->id == "state") continue;
                        const bool is_vector = port->width == 3 && index == 0;
                        const double length = is_vector ? std::hypot (rig.out (i), rig.out (i + 1), rig.out (i + 2)) : std::abs (rig.out (i));
                        if (length > amplitude * (1.0 + 1e-9))
                            fail (port->id, " is ", length, ", claimed ", amplitude);
                    }
                }
            });
        }
    }
}

TEST_CASE ("a node that claims to be passive generates no energy on a closed path", "[nodes][contract]")
{
    for (const auto& type : catalogue())
    {
        const auto hasVector = [] (const std::vector<PortSheet>& ports, std::string_view id) {
            return std::ranges::any_of (ports, [&] (const PortSheet& p) { return p.id == id && p.width == 3 && ! p.list; });
        };
        if (! type.claims || ! hasVector (type.inputs, "position") || ! hasVector (type.outputs, "force")) continue;

        DYNAMIC_SECTION (type.info.id)
        {
            rc::prop ("a tangled loop, run through twice", [&] (unsigned seed) {
                Dice dice { seed };
                Rig rig { type };
                if (dice.once_in (2)) randomParams (rig, dice, Span::usual);
                rig.prepare();
                if (! rig.claims().passive) return;

                const TangledLoop path { dice };
                double given = 0.0, handled = 0.0;
                Vec3 p = path (0);
                rig.input ("position", p);
                rig.tick();
                Vec3 force = rig.vector ("force");
                for (int k = 1; k <= 2 * TangledLoop::steps; ++k)
                {
                    const Vec3 next = path (k);
                    rig.input ("position", next);
                    rig.tick();
                    const Vec3 now = rig.vector ("force");
                    const double work = 0.5 * (now + force).dot (next - p);
                    given += work;
                    handled += std::abs (work);
                    force = now;
                    p = next;
                }
                if (given > 0.01 * handled + 1e-15)
                    fail ("the node gave ", given, " J; the work moved in total was ", handled, " J");
            });
        }
    }
}
