// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactus::examine
{

namespace
{
/// A closed path of random size and shape.
class TangledLoop
{
public:
    static constexpr int steps = 5000;

    explicit TangledLoop (NodeDice& dice)
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
            const double angle = 2.0 * std::numbers::pi * (w + 1) * (k % steps) / steps;
            p += std::sin (angle) * sines[w] + std::cos (angle) * cosines[w];
        }
        return p;
    }

private:
    static constexpr int waves = 4;
    Vec3 sines[waves], cosines[waves];
};

bool hasVector (const std::vector<PortSheet>& ports, std::string_view id)
{
    return std::ranges::any_of (ports, [&] (const PortSheet& p) { return p.id == id && p.width == 3 && ! p.list; });
}
}   // namespace

std::string noClaims (const NodeType& type) { return type.claims ? "" : "it claims nothing"; }

std::string notMechanical (const NodeType& type)
{
    if (! type.claims) return "it claims nothing";
    return hasVector (type.inputs, "position") && hasVector (type.outputs, "force") ? "" : "it has no input `position` or no output `force`";
}

std::string amplitudeFault (const NodeType& type, unsigned seed)
{
    NodeDice dice { seed };
    Rig rig { type };
    if (dice.once_in (2)) randomSettings (rig, dice);
    if (! dice.once_in (4)) randomParams (rig, dice, dice.once_in (2) ? Span::usual : Span::hard);
    rig.prepare();
    const double amplitude = rig.claims().amplitude;
    if (! std::isfinite (amplitude)) return {};

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
            if (length > amplitude * (1.0 + 1e-9)) return say (port->id, " is ", length, ", claimed ", amplitude);
        }
    }
    return {};
}

std::string passiveFault (const NodeType& type, unsigned seed)
{
    NodeDice dice { seed };
    Rig rig { type };
    if (dice.once_in (2)) randomParams (rig, dice, Span::usual);
    rig.prepare();
    if (! rig.claims().passive) return {};

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
    return given > 0.01 * handled + 1e-15 ? say ("the node gave ", given, " J; the work moved in total was ", handled, " J") : "";
}

}   // namespace tactus::examine
