// SPDX-License-Identifier: MIT
#pragma once

#include "trial_run.hpp"

#include <tactus/run/device/device_numbers.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/result.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// A person at a device, who does what a trial asks for. [main thread]
class TrialPerson
{
public:
    virtual ~TrialPerson() = default;

    virtual void tell (const std::string& text) = 0;

    /// The answer to a question, without spaces around it; "" for Enter alone. Empty: the person ends the trial.
    virtual std::optional<std::string> ask (const std::string& question) = 0;

    /// True if the person has pressed Enter since the last call: what pushes now must stop.
    virtual bool wantsStop() = 0;
};

/// The parts of a trial besides the device.
struct TrialSetting
{
    Json tried = Json::object();   ///< the head of the report: what is tried, by which version
    TrialRun::Options run {};      ///< its rate and its clock

    /// A further way to stop, such as a signal. `press` makes a run stop.
    struct Way
    {
        std::string name;
        std::function<void (TrialRun&)> press;
    };
    std::vector<Way> ways {};

    double pace = 1.0;   ///< factor of the times for which something is pushed or measured; below 1 for tests
};

inline constexpr double trial_push = 0.3;   ///< the largest force of a trial, but for its walls, in N
inline constexpr double trial_wall = 1.0;   ///< the largest force of a wall, in N

/// Leads a person through a trial of a device: homing, noise, rate and age of the readings, directions by hand, buttons, pushes, the damping of the free
/// tool if nothing tells it, walls up to the stiffest that is passive with the smallest damping that this leaves, each way to stop, and the cable. Returns
/// the report:
///
///     {"format": "tactus-trial", "version": 1, "tried": {…},
///      "steps": [{"step": "direction right", "verdict": "as expected", "text": "…"}],
///      "numbers": {"quantum": 1e-5, "delay_s": 0.0007, "mass": 0.2, "damping": 1.9, "coulomb": 0.05},
///      "capture": [{"name": "push right", "graph": {…}, "rows": [[x, y, z, valid, fx, fy, fz], …]}]}
///
/// `delay_s` is the time from a place to the force that answers it, as far as it is known: that which the driver measures, or else the age of the readings.
/// `damping` and `coulomb` are the smallest values that the measurement leaves.
/// A verdict is "as expected", "differs", "measured" (nothing is known to compare it with) or "not tried". Rows have the readings, in m, and the force that
/// the graph asked for, in N, of each tick. The device must have been opened, and nothing else may use it. [main thread]
Json tryDevice (Device&, const GuardLimits&, const TrialSetting&, TrialPerson&);

/// The lines of a report for people.
std::string trialText (const Json& report);

/// The numbers of a device in a report, for `tactus check` at this rate. The delay is in whole ticks, rounded up. Id: trial/format.
Result<DeviceNumbers> trialNumbers (const Json& report, double rate_hz);

/// Computes the captured runs of a report again, without a device. The largest difference of a force, in N. Ids: trial/format, those of the graphs.
Result<double> replayTrial (const Json& report);

}   // namespace tactus::host
