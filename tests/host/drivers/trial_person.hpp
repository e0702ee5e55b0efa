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

    void tell (const std::string&) override {}

    std::optional<std::string> ask (const std::string& question) override
    {
        const auto says = [&] (const char* part) { return question.find (part) != std::string::npos; };
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
        if (now.norm() > felt.norm()) felt = now;
        largest = std::max (largest, now.norm());
        return false;
    }

    Vec3 felt = Vec3::Zero();
    double largest = 0.0;
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
