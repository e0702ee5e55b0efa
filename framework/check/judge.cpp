// SPDX-License-Identifier: MIT
#include "judge.hpp"

#include <tactus/check/judging/role_loops.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

namespace tactus::check
{

namespace
{
using namespace judging;

/// All conditions of one role.
class RoleJudge : RoleLoops
{
public:
    RoleJudge (const Demand& d, const RoleDemand& r, const DeviceNumbers& n, const JudgeOptions& o) : RoleLoops (d, r, n), options (o) {}

    std::vector<Condition> all()
    {
        if (! role.slopes.empty())
        {
            stiffness();
            damping();
            quantum();
            blow();
        }
        jump();
        if (! role.slopes.empty() || role.peak_force > 0.0)
        {
            peakForce();
            slew();
        }
        if (! role.axis.empty()) return std::move (conditions);   // the other conditions are about the tool
        for (const auto& s : demand.stretches)
            if (s.role == role.role) stretch (s), teeth (s);
        for (const auto& wall : demand.deadbeats)
            if (wall.role == role.role) deadbeat (wall);
        for (const auto& t : demand.textures)
            if (t.role == role.role) judgeTexture (demand, t, numbers, options, conditions);
        for (const auto& u : demand.unreached)
            if (u.role == role.role) unreached (u);
        return std::move (conditions);
    }

private:
    const JudgeOptions& options;
    std::vector<Condition> conditions {};

    Condition& add (std::string_view id, std::string_view law, std::string_view unit, std::string sentence)
    {
        return conditions.emplace_back (Condition { .id = id, .role = role.role, .axis = role.axis, .law = law, .unit = unit, .text = std::move (sentence) });
    }

    Condition& add (std::size_t node, std::string_view id, std::string_view law, std::string_view unit, std::string sentence)
    {
        auto& c = add (id, law, unit, std::move (sentence));
        c.node = demand.nodes[node].path;
        return c;
    }

    void stiffness()
    {
        auto& c = add ("stiffness", passive_law, "N*s/m", "");
        judgeContact (*this, options, c);
    }

    void damping()
    {
        const double most = virtualDamping();
        auto& c = add ("damping", "b < 2M/T + 4B/3", "N*s/m", "b " + text (most, "N*s/m") + ", T " + text (1e3 * period_s, "ms"));
        if (! numbers.damping) return unknown (c, most, "damping");
        if (! numbers.mass) return unknown (c, most, "mass");
        const double limit = largestDamper();
        if (motorMass() < numbers.mass->value) c.text += ", M " + text (motorMass(), "kg") + " at the motor";
        std::vector<std::string> ways { "a virtual damping " + below (limit, "N*s/m") };
        if (const auto rate = rateForDamper (most); rate && reaches (numbers, *rate)) ways.push_back ("a rate " + above (*rate, "Hz"));
        decide (c, most, limit, Strict::yes, 1.0, anyOf (ways));
    }

    /// The rate above which a virtual damper does not oscillate, within a thousandth. Empty if there is none.
    std::optional<double> rateForDamper (double damper) const
    {
        const auto rests = [&] (double rate) { return damper < check::largestDamper (numbers, 1.0 / rate); };
        double low = 1.0 / period_s, high = low;
        for (int doubled = 0; doubled < 20 && ! rests (high); ++doubled)
            low = std::exchange (high, 2.0 * high);
        if (! rests (high)) return std::nullopt;
        while (high > 1.001 * low)
            (rests (0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
        return high;
    }

    void quantum()
    {
        const double most = steepest();
        auto& c = add ("quantum", "sigma delta/2 <= f_f", "N", "sigma " + text (most, "N/m"));
        if (! numbers.quantum) return unknown (c, 0.0, "quantum");
        const double delta = numbers.quantum->value, value = 0.5 * most * delta;
        c.text += ", delta " + text (1e6 * delta, "um");
        if (! numbers.coulomb && value > 0.0) return unknown (c, value, "Coulomb friction");
        const double limit = numbers.coulomb ? numbers.coulomb->value : 0.0;
        std::vector<std::string> ways;
        if (limit > 0.0) ways = { "a stiffness of " + atMost (2.0 * limit / delta, "N/m"), "a quantum of " + atMost (2e6 * limit / most, "um") };
        ways.push_back ("a device with a dry friction of " + atLeast (value, "N"));
        decide (c, value, limit, Strict::no, 1.0, anyOf (ways));
    }

    /// Judges a damper that computes the speed from the last positions: each step of the sensor is a blow, which lasts as long as its window.
    void blow()
    {
        double most = 0.0;   // N/m
        for (const auto& s : role.slopes)
        {
            const auto& response = responseAt (s);
            if (response.empty()) most = std::max (most, s.damping / period_s);
            for (const auto& m : response)
                most = std::max (most, Jacobian (m - response.back()).norm());
        }
        if (! (most * period_s > 1e-3 * steepest() * period_s) || ! (virtualDamping() > 0.0)) return;
        auto& c = add ("blow", "b delta/T <= f_f", "N",
                       "b " + text (virtualDamping(), "N*s/m") + ", as if over " + text (1e3 * virtualDamping() / most, "ms"));
        if (! numbers.quantum) return unknown (c, 0.0, "quantum");
        const double delta = numbers.quantum->value, value = most * delta;
        c.text += ", delta " + text (1e6 * delta, "um") + ": each step of the sensor is a blow of b delta/T " + text (value, "N");
        if (! numbers.coulomb && value > 0.0) return unknown (c, value, "Coulomb friction");
        const double limit = numbers.coulomb ? numbers.coulomb->value : 0.0;
        std::vector<std::string> ways;
        if (dampers().are_predicted && dampers().leaveUnclaimed (virtualDamping()))
            ways.emplace_back (smaller_b);
        else if (limit > 0.0)
        {
            ways.push_back ("a window of " + atLeast (1e3 * virtualDamping() * delta / limit, "ms")
                            + " for the speed (the setting \"window\" or a motion.velocity)");
            ways.push_back ("a virtual damping of " + atMost (virtualDamping() * limit / value, "N*s/m"));
        }
        else
            ways.emplace_back ("no virtual damping");
        if (limit > 0.0) ways.push_back ("a quantum of " + atMost (1e6 * delta * limit / value, "um"));
        ways.push_back ("a device with a dry friction of " + atLeast (value, "N"));
        decide (c, value, limit, Strict::no, 1.0, anyOf (ways));
    }

    /// A force that steps by F changes by F from one step of the sensor to the next, so its slope is at least F/delta.
    void jump()
    {
        const Jump* most = nullptr;
        for (const auto& j : demand.jumps)
            if (j.role == role.role && (most == nullptr || j.force > most->force)) most = &j;
        if (most == nullptr) return;
        auto& c = add ("jump", "(2d + 1) F T/(2 delta) <= B", "N*s/m",
                       "the force steps by F " + text (most->force, "N") + " against the movement at " + text (most->t_s, "s"));
        if (most->node) c.node = demand.nodes[*most->node].path;
        if (! numbers.quantum) return unknown (c, 0.0, "quantum");
        const double delta = numbers.quantum->value, value = most->force * period_s * (0.5 + delay()) / delta;
        c.text += ", delta " + text (1e6 * delta, "um");
        if (! numbers.damping) return unknown (c, value, "damping");
        const double limit = numbers.damping->value;
        decide (c, value, limit, Strict::no, 1.0,
                limit > 0.0 ? "a force that rises over " + atLeast (1e3 * most->force / stiffestWall (limit, period_s, delay()), "mm")
                            : std::string ("a force that does not step"));
    }

    void peakForce()
    {
        auto& c = add ("peak_force", "|f| <= f_max", "N", "the largest force along the motion");
        if (! numbers.peak_force) return unknown (c, role.peak_force, "peak force");
        decide (c, role.peak_force, numbers.peak_force->value, Strict::no, 1.0,
                "weaker forces, or a device that gives " + atLeast (role.peak_force, "N"));
    }

    /// A structure that follows a sine of the amplitude f_max up to F_0 follows changes of force of up to 2 pi F_0 f_max.
    void slew()
    {
        auto& c = add ("slew", "|df/dt| <= 2 pi F_0 f_max", "N/s", "the fastest change of force along the motion, from tick to tick");
        if (! numbers.first_mode) return unknown (c, role.fastest_force, "first mode");
        if (! numbers.peak_force && numbers.first_mode->value < inf) return unknown (c, role.fastest_force, "peak force");
        const double limit = numbers.first_mode->value < inf ? 2.0 * std::numbers::pi * numbers.first_mode->value * numbers.peak_force->value : inf;
        const auto stiffer = "a device whose first mode is " + atLeast (numbers.first_mode->value * role.fastest_force / std::max (limit, 1e-300), "Hz");
        const bool is_contact = steepest() * role.speed >= 0.5 * role.fastest_force;   // a filter in its loop would make it swing
        decide (c, role.fastest_force, limit, Strict::no, 1.0,
                is_contact ? "a softer contact, slower strokes, or " + stiffer
                           : "a filter.butterworth2 at " + text (numbers.first_mode->value, "Hz") + " before the motor, a softer onset, or " + stiffer);
    }

    void stretch (const Stretch& s)
    {
        const bool has_teeth = s.teeth > 0.0 && s.teeth < s.d_max;
        const double limit = has_teeth ? s.teeth : s.d_max;
        auto& c = add (s.node, "d_max", "delta < d_max, preferably 10 delta < d_max", "m",
                       "slides at a stretch of " + text (1e6 * s.d_max, "um") + (has_teeth ? ", with teeth of " + text (1e6 * s.teeth, "um") : ""));
        if (! numbers.quantum) return unknown (c, 0.0, "quantum");
        const double delta = numbers.quantum->value;
        decide (c, delta, limit, Strict::yes, Factors::better,
                (has_teeth ? "teeth " : "a stretch ") + above (1e7 * delta, "um") + (has_teeth ? " (d_max times static_ratio - 1)" : "")
                    + ", or a quantum " + below (1e5 * limit, "um"));
    }

    /// A hand that crosses a tooth in less than a tick feels teeth of another length.
    void teeth (const Stretch& s)
    {
        if (s.teeth > 0.0) judgeTeeth (demand, s, numbers, options, add (s.node, "scanning", "alpha k v T < 1", "1", ""));
    }

    /// The node computes the speed from the last positions, and the forces that change it within two ticks. A position that is wrong by
    /// delta then causes a force of about M delta/T^2.
    void deadbeat (const Deadbeat& wall)
    {
        judgeDeadbeat (demand, wall, numbers, add (wall.node, "deadbeat", "d and M as assumed, M delta/(2 T^2) <= f_f", "N", ""));
    }

    void unreached (const Unreached& u)
    {
        const auto conditions_of = u.renders_texture ? "its texture" : "the stretch at which it slides";
        auto& c = add (u.node, "reach", "the motion reaches the node", "1", std::string ("the node gave no force, so ") + conditions_of + " is not judged");
        c.verdict = Verdict::not_reached;
        c.remedy = "another motion of the hand: --sweep, --device ROLE=gesture:NAME or --device ROLE=trace:FILE.csv";
    }
};
}   // namespace

std::string_view nameOf (Verdict verdict) noexcept
{
    constexpr std::array<std::string_view, 9> names { "holds", "close", "passive", "passive_here", "stable", "unstable", "broken", "unknown", "not reached" };
    return names[static_cast<std::size_t> (verdict)];
}

double Condition::margin() const noexcept
{
    if (! isKnown()) return 0.0;
    if (verdict == Verdict::stable || verdict == Verdict::unstable) return may_grow;
    return value > 0.0 ? limit / value : inf;
}

std::vector<Condition> judge (const Demand& demand, std::span<const RoleDevice> devices, const JudgeOptions& options)
{
    std::vector<Condition> all;
    for (const auto& role : demand.roles)
    {
        const auto numbers = numbersFor (devices, role);
        std::ranges::move (RoleJudge (demand, role, numbers, options).all(), std::back_inserter (all));
    }
    judgeLinks (demand, devices, options, all);
    return all;
}

bool isBroken (std::span<const Condition> all) noexcept
{
    return std::ranges::any_of (all, &Condition::isBroken);
}

}   // namespace tactus::check
