// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/compile.hpp>
#include <tactus/run/guard.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/result.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The configuration that the firmware of a SmartKnob takes instead of torques (scottbez1/smartknob, proto/smartknob.proto, protocol version 1; facts
/// only): evenly spaced detents, perhaps with a stop at each end. It pulls towards the middle of the nearest one with 4 V/rad times the strength,
/// beyond a dead zone, and takes the next detent for the nearest one beyond `snap_point`.
struct KnobConfig
{
    std::int32_t min_position = 0, max_position = -1;   ///< from 0, which is where the knob begins, clockwise; max below min: no ends
    double sub_position = 0.0;                          ///< how far it begins from the middle of its detent, clockwise, in widths
    double width = 0.0;                                 ///< between two detents, in rad
    double detent_strength = 0.0, endstop_strength = 0.0;
    double snap_point = 0.5;   ///< in widths, at least 0.5
    std::string text;          ///< what its display shows

    bool hasEnds() const noexcept { return max_position >= min_position; }
};

/// The angle in rad by which a knob pulls back from the middle of its detent, counterclockwise, after it was turned to an angle. The torque is this
/// times the strength times `volts_per_rad` times the torque per volt of its motor. [any thread]
class KnobLaw
{
public:
    static constexpr double volts_per_rad = 4.0, most_volts = 5.0;

    explicit KnobLaw (const KnobConfig&) noexcept;

    struct Pull
    {
        double angle = 0.0;    ///< rad
        bool at_end = false;   ///< the strength is that of the stops
    };

    /// `angle`: counterclockwise, from where the knob began, in rad. One tick of the firmware, which goes on by one detent at most.
    Pull operator() (double angle) noexcept;

private:
    const KnobConfig config;
    double centre;
    std::int32_t position = 0;
};

struct KnobOptions
{
    double torque_per_volt = 0.0;   ///< of the motor, in N m; 0: a guess is used, with a warning
};

/// A knob's configuration, and how well its torques are those of the graph.
struct KnobFit
{
    KnobConfig config;
    double torque_per_volt = 0.0;      ///< in N m
    double largest = 0.0, rms = 0.0;   ///< the largest torque of the graph, and the root mean square of what the knob's differs by, in N m
};

/// Turns the knob of a graph by half a turn to each side and back, so slowly that all torques settle, and finds the configuration whose torques come
/// closest. The graph must have one role, whose torque about z depends on its rotation about z alone. Ids, all errors: smartknob/role,
/// smartknob/moves (the torque does not settle), smartknob/no_detent, smartknob/uneven, smartknob/fine, smartknob/shape (less than half of the power
/// of the torque is the knob's), smartknob/strong, smartknob/limit (the knob could give more than `max_torque` of the role: no guard comes after it).
/// [main thread]
Result<KnobFit> fitKnob (const std::shared_ptr<Plan>&, const KnobOptions&, double max_torque = GuardLimits::none);

/// The files of an export: the configuration as JSON, a message that sets it, as it goes on the serial line, and how to use them. Appends warnings:
/// smartknob/shape, smartknob/torque.
std::vector<std::pair<std::string, std::string>> knobFiles (const std::string& stem, const KnobFit&, const KnobOptions&, Messages&);

/// The message that sets this configuration, as it goes on the serial line (115200 Bd).
std::string knobMessage (const KnobConfig&);

}   // namespace tactus::host
