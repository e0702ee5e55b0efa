// SPDX-License-Identifier: MIT
#pragma once

#include "support/waiting.hpp"

#include <host/devices/trial/trial.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>

namespace tactus::test
{

/// A person who holds a fake arm and does what a trial asks. Positions and forces are in the axes of Tactus, turned from those of the arm by the test.
struct TrialHand final : host::TrialPerson
{
    std::function<void (const Vec3&)> move;      // the hand, in m; returns when the arm is there
    std::function<Vec3()> force;                 // on the tool now
    std::function<void (unsigned)> press = {};   // these buttons; returns when they have been read
    std::function<void (bool)> release = {};     // lets go of the tool, or takes it again
    std::function<void()> lean = {};             // on a wall 5 mm below the middle
    std::function<void()> unplug = {};

    void tell (const std::string&) override {}

    std::optional<std::string> ask (const std::string& question) override
    {
        const auto says = [&] (const char* part) { return question.find (part) != std::string::npos; };
        if (says ("Can you let go")) return release ? "yes" : "no";
        if (says ("Has the push ended") && has_unplugged) return "yes";   // nothing tells what the motors of an arm do that is away
        if (says ("let go of it") || has_released)
        {
            has_released = ! has_released;
            release (has_released);
        }
        if (says ("the cable: the tool")) return unplug ? "yes" : "no";
        if (says ("Pull the cable"))
        {
            eventually ([&] { return force().norm() > 0.1; });
            unplug();
            has_unplugged = true;
        }
        is_at_wall = says ("there is a wall");
        if (says ("buzz")) return "no";
        if (says ("near the middle") || says ("middle of its space, and")) move (Vec3::Zero());
        if (says ("5 cm to the right")) move ({ 0.05, 0.0, 0.0 });
        if (says ("5 cm away")) move ({ 0.0, 0.05, 0.0 });
        if (says ("5 cm up")) move ({ 0.0, 0.0, 0.05 });
        if (says ("Press each button") && press) press (2);
        if (says ("Hold the tool loosely")) felt.setZero();
        if (says ("It pushes up now")) eventually ([&] { return force().norm() > 0.1; });
        if (says ("Has the push ended")) return eventually ([&] { return force().isZero (0.0); }) ? "yes" : "no";
        if (says ("before it came back")) return "yes";
        if (! says ("Which way")) return "";
        Eigen::Index axis = 0;
        if (felt.cwiseAbs().maxCoeff (&axis) < 0.1) return "none";
        return std::array { "left", "right", "towards", "away", "down", "up" }[static_cast<std::size_t> (2 * axis + (felt[axis] > 0.0 ? 1 : 0))];
    }

    bool wantsStop() override   // asked all the time while something pushes
    {
        const Vec3 now = force();
        if (is_at_wall && lean) lean();
        if (now.norm() > felt.norm()) felt = now;
        auto& most = is_at_wall ? largest_at_wall : largest;
        most = std::max (most, now.norm());
        return is_at_wall && now.norm() > 0.3;   // it has felt the wall
    }

    Vec3 felt = Vec3::Zero();
    bool is_at_wall = false, has_released = false, has_unplugged = false;
    double largest = 0.0, largest_at_wall = 0.0;
};

inline std::string verdictOf (const Json& report, const std::string& step)
{
    for (const auto& each : report.at ("steps"))
        if (each.value ("step", std::string()) == step) return each.value ("verdict", std::string());
    return "no such step";
}

/// The steps that must be as expected on a fake arm.
inline constexpr const char* steps_of_trial[] { "homing", "direction right", "direction away", "direction up", "push right",
                                                "push left", "push away", "push towards", "push up", "push down",
                                                "stop by Enter", "stop by the end of the run", "stop by silence" };

}   // namespace tactus::test
