// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include <cmath>

namespace tactus::examine
{

namespace
{
std::string notFinite (const Rig& rig)
{
    for (std::size_t i = 0; i < rig.outputs.size(); ++i)
        if (! std::isfinite (rig.out (i)))
        {
            std::ostringstream inputs;
            for (const double v : rig.in)
                inputs << ' ' << v;
            return say (rig.outputs[i].port->id, " is ", rig.out (i), " for inputs", inputs.str());
        }
    return {};
}

Span anySpan (NodeDice& dice) { return dice.once_in (2) ? Span::usual : Span::hard; }
}   // namespace

std::string rangeFault (const NodeType& type, unsigned seed)
{
    NodeDice dice { seed };
    static constexpr double rates[] { 100.0, 1000.0, 4000.0, 48000.0 };
    Rig rig { type, rates[dice.below (4)] };
    if (dice.once_in (2)) randomSettings (rig, dice);
    if (! dice.once_in (4)) randomParams (rig, dice, anySpan (dice));
    rig.prepare();

    const double size = dice.size();
    for (int k = 0; k < 100; ++k)
    {
        if (dice.once_in (20)) randomParams (rig, dice, anySpan (dice));
        randomInputs (rig, dice, size);
        rig.tick();
        if (auto fault = notFinite (rig); ! fault.empty()) return fault;
    }
    return {};
}

std::string sizeFault (const NodeType& type, unsigned seed)
{
    NodeDice dice { seed };
    Rig rig = prepared (type);
    for (int k = 0; k < 20; ++k)
    {
        randomTameInputs (rig, dice);
        rig.tick();
    }
    return rig.wroteTooFar() ? say ("it writes past the end of its outputs, whose size is given as ", type.outputs_size, " bytes") : "";
}

}   // namespace tactus::examine
