// SPDX-License-Identifier: MIT
#include "workspace.hpp"

#include <host/devices/hid/profile/kinematics_reader.hpp>
#include <tactus/node/device_parts.hpp>
#include <tactus/text/object_reader.hpp>
#include <tactus/text/units.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr double least = 1e-3, most = 1e3;   // a scale beyond these limits must be a mistake

/// True if each coordinate of the graph is one of the device, or its negative.
bool isAligned (const Mat3& axes) { return ((axes.array() == 0.0) || (axes.array().abs() == 1.0)).all(); }

/// The same axes, perpendicular to the last bit but one: a file gives them with a few digits.
Mat3 straightened (const Mat3& axes)
{
    if (isAligned (axes)) return axes;
    const Vec3 x = axes.row (0).transpose().normalized();
    const Vec3 y = (axes.row (1).transpose() - x.dot (axes.row (1)) * x).normalized();
    Mat3 straight;
    straight.row (0) = x.transpose();
    straight.row (1) = y.transpose();
    straight.row (2) = (axes.determinant() < 0.0 ? -1.0 : 1.0) * x.cross (y).transpose();
    return straight;
}

Mat3 readBasis (ObjectReader& in)
{
    const Json& json = in.object ("axes");
    if (! in.has ("axes")) return Mat3::Identity();
    if (const auto axes = hid::axesOf (json)) return straightened (*axes);
    in.error ("axes", "device/axes", "the axes are not three axes, or three rows of numbers, that have the length 1 and are perpendicular",
              R"(write which axis of the device is x, y and z of the graph, such as ["y", "-x", "z"], or three rows of a rotation)");
    return Mat3::Identity();
}

/// The bit of the clutch, which is named, or counted from 0; -1: the device does not have it.
int clutchBit (const Workspace& w, const DeviceLayout& has)
{
    if (w.clutch.empty()) return -1;
    if (const int named = partNamed (w.clutch, has.buttons); named >= 0) return named;
    int number = -1;
    const auto* end = w.clutch.data() + w.clutch.size();
    const auto read = std::from_chars (w.clutch.data(), end, number);
    return read.ec == std::errc() && read.ptr == end && number >= 0 && number < static_cast<int> (has.buttons.size()) ? number : -1;
}

constexpr double a_little_less = 1.0 - 1e-15;   // so that rounding never makes a turned force larger
}   // namespace

Workspace readWorkspace (const Json& json, std::string where, Messages& messages)
{
    ObjectReader in (json, std::move (where), messages);
    Workspace w;
    w.scale = in.number ("scale", unit::gain, { .min = least, .max = most }, w.scale);
    w.offset = in.vector ("offset", unit::metre, w.offset);
    if (! (w.offset.cwiseAbs().maxCoeff() <= Workspace::farthest))
    {
        in.error ("offset", "device/out_of_range", "the offset is more than 1000 m", "give the position of the device's origin in the graph, in m");
        w.offset = Vec3::Zero();
    }
    w.axes = readBasis (in);
    w.clutch = in.text ("clutch");
    in.finish();
    return w;
}

GuardLimits inWorkspace (GuardLimits limits, const Workspace& w) noexcept
{
    limits.workspace_scale *= w.scale;
    limits.max_brake /= w.scale;
    limits.max_brake_slew /= w.scale;
    limits.brake_at_stop /= w.scale;
    return limits;
}

std::optional<Message> wrongClutch (const Workspace& w, const DeviceLayout& has)
{
    if (w.clutch.empty() || clutchBit (w, has) >= 0) return std::nullopt;
    return Message::error ("device/no_button", "/workspace/clutch", "the device has " + lacking ("button", "buttons", w.clutch, has.buttons),
                           "name one of its buttons, or give its number, counted from 0; or leave the clutch out");
}

WorkspaceDevice::WorkspaceDevice (std::unique_ptr<Device> d, const Workspace& w, const GuardLimits& limits)
    : device (std::move (d)), workspace (w), spin (w.isMirrored() ? Mat3 (-w.axes) : w.axes), is_turned (w.isTurned()),
      is_oblique (! isAligned (w.axes)), is_moved (w.isTurned() || w.scale != 1.0 || ! w.offset.isZero (0.0)), clutch_button (clutchBit (w, device->layout())),
      max_still (limits.max_still),
      still_force (limits.still_force), still_torque (limits.still_torque), shown { { w.offset.x(), w.offset.y(), w.offset.z() } }, clutch (w.offset)
{
    latest_origin.store (shown);
}

void WorkspaceDevice::moveTo (const Vec3& origin) noexcept
{
    const auto n = goals_told.load (std::memory_order_relaxed) + 1;
    for (std::size_t i = 0; i < 3; ++i)
        goals[n % 2][i].store (origin[static_cast<int> (i)], std::memory_order_release);
    goals_told.store (n, std::memory_order_release);
}

Vec3 WorkspaceDevice::origin() const noexcept
{
    const auto now = latest_origin.load();
    const auto n = goals_told.load (std::memory_order_relaxed);
    if (now.goals == n) return Vec3 (now.at.data());
    const auto& goal = goals[n % 2];
    return { goal[0].load (std::memory_order_relaxed), goal[1].load (std::memory_order_relaxed), goal[2].load (std::memory_order_relaxed) };
}

/// A goal that is being written over is the one before the latest, which comes with a new count on the next tick.
void WorkspaceDevice::takeGoal() noexcept
{
    const auto n = goals_told.load (std::memory_order_acquire);
    if (n == goals_taken) return;
    Vec3 goal;
    for (std::size_t i = 0; i < 3; ++i)
        goal[static_cast<int> (i)] = goals[n % 2][i].load (std::memory_order_acquire);
    if (goals_told.load (std::memory_order_relaxed) != n) return;
    goals_taken = n;
    clutch.moveTo (goal - workspace.offset);
}

void WorkspaceDevice::prepare (double dt_s)
{
    dt = dt_s;
    device->prepare (dt_s);
}

DeviceLayout WorkspaceDevice::layout() const
{
    auto has = device->layout();
    has.mechanics.mass /= workspace.scale;
    has.mechanics.damping /= workspace.scale;
    has.brake /= workspace.scale;
    return has;
}

void WorkspaceDevice::write (const Effort& guarded) noexcept
{
    clutch.wrote (guarded);
    if (! is_turned && guarded.brake == 0.0) return device->write (guarded);
    Effort there = guarded;
    there.brake *= workspace.scale;   // the same force at the speed of the device
    if (is_turned)
    {
        const double share = is_oblique ? a_little_less : 1.0;
        there.force = force = share * (workspace.axes.transpose() * guarded.force);
        there.torque = torque = share * (spin.transpose() * guarded.torque);
    }
    device->write (there);
}

/// A coordinate of the device that stands still, which the guard cannot see in oblique axes.
void WorkspaceDevice::watch (Reading& reading) noexcept
{
    if (! reading.valid) return;
    still (reading.position, force, still_force, dt);
    still_turn (reading.rotation, torque, still_torque, dt);
    if (! (std::max (still.time(), still_turn.time()) > max_still)) return;
    reading.valid = false;
    reading.fault = ReadingFault::frozen;
}

/// Tells the main thread where the origin is, if it has moved.
void WorkspaceDevice::showOrigin() noexcept
{
    const Vec3 at = workspace.offset + clutch.moved();
    const std::uint64_t reached = clutch.hasGoal() ? shown.goals : goals_taken;
    if (at == Vec3 (shown.at.data()) && reached == shown.goals) return;
    shown = { { at.x(), at.y(), at.z() }, reached };
    latest_origin.store (shown);
}

Reading WorkspaceDevice::read() noexcept
{
    auto reading = device->read();
    if (is_oblique && max_still != GuardLimits::none) watch (reading);
    if (is_moved)
    {
        reading.position = workspace.toGraph (reading.position);
        reading.true_position = workspace.toGraph (reading.true_position);
        reading.true_velocity = workspace.scale * (workspace.axes * reading.true_velocity);
    }
    if (is_turned)
    {
        reading.rotation = spin * reading.rotation;
        reading.unrendered_force = workspace.axes * reading.unrendered_force;
        reading.unrendered_torque = spin * reading.unrendered_torque;
    }
    takeGoal();
    const bool is_pressed = clutch_button >= 0 && (reading.buttons >> clutch_button & 1u) != 0;
    clutch (reading, is_pressed || is_held.load (std::memory_order_relaxed));
    showOrigin();
    return reading;
}

}   // namespace tactus::host
