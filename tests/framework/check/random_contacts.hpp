// SPDX-License-Identifier: MIT
#pragma once

#include "own_loop.hpp"

#include <tactus/kit/random.hpp>
#include <tactus/run/device/sim.hpp>

#include <string>
#include <vector>

namespace tactus::test
{

/// A random graph that one tool touches, the device, and the path of the hand: down into the contact, sideways, back, and up.
struct RandomContact
{
    std::string text, kinds;   // JSON; its parts
    Simulation device;
    double rate_hz = 1000.0;
    std::vector<Vec3> path;            // tick by tick
    std::vector<std::size_t> places;   // ticks of the path at which the tool is let go
};

/// The same seed gives the same contact with every compiler: no two draws are arguments of one call, whose order is open.
class RandomContacts
{
public:
    explicit RandomContacts (std::uint64_t seed) : random (seed) {}

    RandomContact draw()
    {
        made = {};
        nodes = R"("at": { "type": "device.position", "role": "h" }, "motor": { "type": "device.force", "role": "h" })";
        wires.clear();
        auto& m = made.device;
        made.rate_hz = std::round (between (500.0, 4000.0));
        m.mass = between (0.03, 0.3);
        m.damping = between (0.003, 0.06) * m.mass * made.rate_hz;
        if (chance (0.3)) m.delay = 1 + int (3.0 * part());
        if (chance (0.3)) m.quantum = between (1e-6, 3e-5);
        if (chance (0.3)) m.coulomb = between (0.005, 0.1);
        if (chance (0.2)) m.first_mode = between (0.03, 0.3) * made.rate_hz;
        passive = 2.0 * m.damping * made.rate_hz / (2.0 * m.delay + 1.0);
        top = 0.0;
        depth = std::clamp (1.0 / passive * between (0.3, 3.0), 1e-4, 4e-3);

        const double kind = part();
        if (kind < 0.35)
            floor();
        else if (kind < 0.45)
            hertz();
        else if (kind < 0.55)
            coupling();
        else if (kind < 0.65)
            surface();
        else if (kind < 0.75)
            field();
        else if (kind < 0.85)
            detents();
        else
            liquid();
        if (has_load && chance (0.5)) friction();
        if (chance (0.2)) corner();
        if (chance (0.15)) liquid();
        if (m.first_mode == 0.0 && chance (0.15)) brake();
        walk();
        made.text = R"({ "format": "tactus-graph", "version": 2, "name": "random", "rate_hz": )" + number (made.rate_hz) + R"(, "nodes": { )" + nodes
                    + R"( }, "wires": [ )" + wires + " ] }";
        return made;
    }

    double part() { return double (random.bits() >> 11) * 0x1p-53; }
    double between (double low, double high) { return low * std::pow (high / low, part()); }
    bool chance (double p) { return part() < p; }

    Vec3 direction()
    {
        for (;;)
            if (const Vec3 v { 2.0 * part() - 1.0, 2.0 * part() - 1.0, 2.0 * part() - 1.0 }; v.norm() > 0.1 && v.norm() <= 1.0) return v.normalized();
    }

private:
    Random random;
    RandomContact made;
    std::string nodes, wires;
    double passive = 0.0, top = 0.0, depth = 0.0;   // N/m; m; m
    bool has_load = false;
    std::string load;

    static std::string number (double v)
    {
        char text[32];
        std::snprintf (text, sizeof text, "%.9g", v);
        return text;
    }

    void node (const std::string& name, const std::string& type, const std::string& rest = "")
    {
        nodes += R"(, ")" + name + R"(": { "type": ")" + type + '"' + (rest.empty() ? "" : ", " + rest) + " }";
    }

    void wire (const std::string& from_to, const std::string& gain = "")
    {
        wires += (wires.empty() ? "" : ", ") + (gain.empty() ? '"' + from_to + '"' : R"({ "wire": ")" + from_to + R"(", "gain": ")" + gain + R"(" })");
    }

    double stiffness() { return passive * between (0.15, 8.0); }
    double damper() { return chance (0.4) ? 0.0 : made.device.damping * between (0.1, 6.0); }

    void floor()
    {
        made.kinds += "plane ";
        const auto window = chance (0.3) ? R"(, "settings": { "window": )" + number (between (2.0, 8.0) / made.rate_hz) + " }" : std::string();
        const double b = damper(), k = stiffness();
        node ("floor", "deform.plane", R"("params": { "stiffness": )" + number (k) + R"(, "damping": )" + number (b) + " }" + window);
        wire ("at.position -> floor.position");
        if (chance (0.15))
        {
            made.kinds += "predictive ";
            node ("held", "hold.predictive", R"("params": { "limit": 1e6 })");
            wire ("floor.force -> held.in");
            wire ("held.out -> motor.force");
        }
        else
            wire ("floor.force -> motor.force");
        has_load = true;
        load = "floor.resistance";
    }

    void hertz()
    {
        made.kinds += "hertz ";
        // The slope at the depth is that of the wall that the device could have, times a factor: 1.5 a sqrt (depth).
        const double a = stiffness() / (1.5 * std::sqrt (depth));
        node ("floor", "deform.plane",
              R"("settings": { "law": { "power": [)" + number (a) + R"(, 1.5] } }, "params": { "damping": )" + number (damper()) + " }");
        wire ("at.position -> floor.position");
        wire ("floor.force -> motor.force");
        has_load = true;
        load = "floor.resistance";
    }

    void coupling()
    {
        made.kinds += "coupling ";
        const double wall = between (1e3, 1e7), b = damper(), k = stiffness();
        node ("coupled", "coupling.virtual",
              R"("params": { "stiffness": )" + number (k) + R"(, "damping": )" + number (b) + R"(, "wall_stiffness": )" + number (wall) + " }");
        wire ("at.position -> coupled.position");
        wire ("coupled.force -> motor.force");
    }

    void surface()
    {
        made.kinds += "surface ";
        node ("pad", "deform.surface");
        wire ("at.position -> pad.position");
        wire ("pad.force -> motor.force", number (stiffness() / 1000.0));
    }

    void field()
    {
        made.kinds += "field ";
        const double k = stiffness(), turn = chance (0.5) ? k * between (0.001, 0.3) : 0.0;
        const double z = chance (0.2) ? -between (0.05, 1.0) * k : k * between (0.3, 1.0);
        wire ("at.position.x -> motor.force.x", number (-k) + " N/m");
        wire ("at.position.z -> motor.force.z", number (-z) + " N/m");
        wire ("at.position.y -> motor.force.y", number (-k * between (0.3, 1.0)) + " N/m");
        if (turn > 0.0)
        {
            wire ("at.position.y -> motor.force.x", number (-turn) + " N/m");
            wire ("at.position.x -> motor.force.y", number (turn) + " N/m");
        }
    }

    void detents()
    {
        made.kinds += "detents ";
        const double wave = 6.283185307179586 / between (2e-3, 8e-3), force = stiffness() / wave;   // 1/m, N
        node ("parts", "vector.split");
        node ("joined", "vector.join");
        node ("law", "signal.expression", R"_("settings": { "inputs": 1, "text": "-)_" + number (force) + "*sin(" + number (wave) + R"_(*in0)" })_");
        wire ("at.position -> parts.in");
        wire ("parts.x -> law.in[0]");
        wire ("law.out -> joined.x");
        wire ("joined.out -> motor.force");
    }

    void liquid()
    {
        if (made.kinds.find ("liquid") != std::string::npos) return;
        made.kinds += "liquid ";
        const double most = made.device.mass * made.rate_hz * between (0.05, 4.0) / (2.0 * made.device.delay + 1.0);   // 2M/T is the limit
        const auto law = chance (0.5) ? R"("linear": )" + number (most) + R"(, "max_damping": )" + number (most)
                                      : R"("linear": )" + number (0.05 * most) + R"(, "quadratic": )" + number (most * between (0.3, 20.0))
                                            + R"(, "max_damping": )" + number (most);
        node ("liquid", "field.viscous", R"("params": { )" + law + " }");
        wire ("at.position -> liquid.position");
        wire ("liquid.force -> motor.force");
    }

    void friction()
    {
        made.kinds += "friction ";
        const char* adhesions[] { "stick", "dahl", "dupont" };
        const char* loads[] { "bound", "scale", "passive" };
        const auto its_load = loads[std::size_t (3.0 * part())], adhesion = adhesions[std::size_t (3.0 * part())];
        const double d_max = between (5e-5, 1e-3), k = chance (0.6) ? stiffness() : 0.0, mu = 0.1 + 0.6 * part();
        node ("drag", "friction.elasto_plastic",
              R"("params": { "mu": )" + number (mu) + R"(, "stiffness": )" + number (k) + R"(, "d_max": )" + number (d_max) + R"(, "adhesion": ")" + adhesion
                  + R"(", "load": ")" + its_load + R"(" })");
        wire ("at.position -> drag.position");
        wire (load + " -> drag.normal_force");
        wire ("drag.force -> motor.force");
    }

    void corner()
    {
        made.kinds += "corner ";
        const double angle = (0.2 + 0.8 * part()) * 1.5707963267948966, x = std::sin (angle), z = std::cos (angle);
        const double b = damper(), k = stiffness();
        // The stroke ends 8 mm to the right, as deep in this wall as in the floor.
        node ("side", "deform.plane",
              R"("params": { "normal": [)" + number (-x) + ", 0, " + number (z) + R"(], "offset": )" + number (-0.008 * x) + R"(, "stiffness": )"
                  + number (k) + R"(, "damping": )" + number (b) + " }");
        wire ("at.position -> side.position");
        wire ("side.force -> motor.force");
    }

    void brake()
    {
        made.kinds += "brake ";
        made.device.brake = between (0.5, 20.0) * made.device.damping;
        node ("brakes", "device.brake", R"("role": "h")");
        node ("much", "signal.constant", R"("params": { "value": ")" + number (made.device.brake * part()) + R"( N*s/m" })");
        wire ("much.out -> brakes.damping");
    }

    /// 2 s: from 1 mm above down to the depth, a wait, 8 mm to the right, a wait, and back.
    void walk()
    {
        const auto smooth = [] (double u) { return u <= 0.0 ? 0.0 : u >= 1.0 ? 1.0
                                                                             : u * u * (3.0 - 2.0 * u); };
        const auto ticks = std::size_t (2.0 * made.rate_hz);
        for (std::size_t k = 0; k < ticks; ++k)
        {
            const double t = double (k) / made.rate_hz;
            const double down = smooth (t / 0.3) - smooth ((t - 1.7) / 0.3), right = smooth ((t - 0.5) / 0.4) - smooth ((t - 1.3) / 0.3);
            made.path.emplace_back ((8e-3 + depth) * right, 0.3 * depth * right, 1e-3 - (1e-3 + depth) * down);
        }
        for (const double t : { 0.45, 0.7 + 0.1 * part(), 1.2 })
            made.places.push_back (std::size_t (t * made.rate_hz));
    }
};

}   // namespace tactus::test
