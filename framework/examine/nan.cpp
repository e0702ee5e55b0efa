// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include <cmath>
#include <limits>

namespace tactus::examine
{

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The value that an output must have when an input is not finite: -1 for states and triangles, the previous value for what a
/// material remembers, otherwise 0.
double onFault (std::string_view type, std::string_view output, double before)
{
    if (output == "state" || output == "triangle") return -1.0;
    if (output == "dissipated_energy" || output == "crack" || output == "crack_front") return before;
    if (type == "safety.passivity" && output == "energy") return before;
    return 0.0;
}

bool isHit (const PortSheet& port) { return port.unit.kind == UnitRule::Kind::fixed && port.unit.unit.quantity == Quantity::hit; }

std::string wrongAnswer (const Rig& rig, const PortSheet& port, const std::vector<double>& before)
{
    for (std::size_t i = 0; i < rig.outputs.size(); ++i)
    {
        const auto& output = *rig.outputs[i].port;
        if (rig.out (i) != onFault (rig.type().info.id, output.id, before[i]))
            return say (port.id, " is not finite, but ", output.id, " is ", rig.out (i));
    }
    return {};
}

/// True if a node answers like a fresh one, whatever its past.
bool answersLikeFresh (const NodeType& type, NodeDice& dice, bool with_fault)
{
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
}
}   // namespace

std::string noInputs (const NodeType& type) { return type.inputs.empty() ? "it has no inputs" : ""; }
std::string peeks (const NodeType& type) { return type.peek ? "it gives its outputs before it reads its inputs" : ""; }

std::string nanFault (const NodeType& type, unsigned seed)
{
    NodeDice dice { seed };
    Rig rig = prepared (type), twin = prepared (type);
    if (rig.in.empty()) return {};
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
        if (auto fault = wrongAnswer (rig, port, before); ! fault.empty()) return fault;

    for (int k = 0; k < 20; ++k)
    {
        randomTameInputs (rig, dice);
        if (! std::isfinite (rig.in[at])) rig.in[at] = 0.0;
        rig.tick();
        for (std::size_t i = 0; i < rig.outputs.size(); ++i)
            if (! std::isfinite (rig.out (i)))
                return say (rig.outputs[i].port->id, " is still ", rig.out (i), ' ', k + 1, " ticks after ", port.id, " was not finite");
    }
    return {};
}

// An output must become nonzero after a fault if it does so on a node without a fault, and only then.
std::string revivalFault (const NodeType& type, unsigned seed)
{
    std::vector<char> lives, lives_on;
    std::vector<std::string_view> names;
    NodeDice dice { seed };
    for (int trial = 0; trial < 50; ++trial)
    {
        Rig rig = prepared (type), twin = prepared (type);
        lives.resize (rig.outputs.size());
        lives_on.resize (rig.outputs.size());
        names.clear();
        for (const auto& output : rig.outputs)
            names.push_back (output.port->id);
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
    for (std::size_t i = 0; i < lives.size(); ++i)
        if (lives[i] != lives_on[i])
            return say (names[i], lives[i] ? " stays 0 after an input was not finite" : " is not 0, but only after an input was not finite");
    return {};
}

std::string memoryFault (const NodeType& type, unsigned seed)
{
    NodeDice dice { seed };
    for (int k = 0; k < 50; ++k)
        if (! answersLikeFresh (type, dice, false)) return {};   // it has a memory
    for (int k = 0; k < 50; ++k)
        if (! answersLikeFresh (type, dice, true)) return "it has no memory, but remembers that an input was not finite";
    return {};
}

}   // namespace tactus::examine
