// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/assets/file_assets.hpp>
#include <host/devices/hid/profile_reader.hpp>
#include <host/devices/sessions/session_file.hpp>
#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/graph/graph.hpp>

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace tactus::host
{

/// The device of a role, and the hand that moves it while the graph is measured.
struct LimitRole
{
    std::string role;
    std::string device;   ///< its name, for people
    DeviceNumbers numbers {};
    std::optional<Json> simulated {};       ///< description of a simulated device, whose brake and axes are tried; empty for others
    std::optional<Json> hand {};            ///< description of the device that moves the hand; empty: as the graph describes
    std::filesystem::path hand_folder {};   ///< base of the relative paths in `hand`

    bool operator== (const LimitRole&) const = default;
};

/// The roles that a session binds or a graph describes, with the numbers of their devices in the workspace of the graph: a scale of 2
/// halves mass and damping, and doubles the position quantum. [main thread]
std::vector<LimitRole> limitRolesOf (const graph::Graph&, const LoadedSession&, const hid::LoadedProfiles&);

/// A graph to check, and the devices of its roles.
struct LimitJob
{
    graph::Graph graph;
    double rate_hz = 0.0;   ///< 0: the rate of the graph
    std::vector<LimitRole> roles {};
};

/// A condition that a graph breaks or nearly breaks, or that holds only with usual hands.
struct Limit
{
    bool is_broken = false;
    std::string id;                      ///< id of the condition, such as "stiffness"; "diverged" if the forces drive a tool away
    std::vector<std::string> nodes {};   ///< paths of the nodes concerned; for a whole role: the steepest node, and those that push the device
    std::string text, remedy;            ///< in one sentence, and the first of what would help
    std::string details {};              ///< value and limit, the numbers behind them, the law, and all that would help

    bool operator== (const Limit&) const = default;
};

/// The limits of a node's contact, in multiples of its stiffness and its damping now.
struct ContactLimit
{
    std::string node;     ///< its path
    std::string device;   ///< name of the role's device
    check::Verdict verdict = check::Verdict::passive;
    double passive_up_to = 0.0;   ///< by its own force alone, or that of the whole contact if the nodes do not explain it
    double stable_up_to = 0.0;    ///< without a hand and with the usual ones; 0 if it is not known: the contact is passive, or only trials judge it
    std::string swinging {};      ///< path of the node whose loop makes the contact swing, if the loop of this node rests; else empty

    bool operator== (const ContactLimit&) const = default;
};

/// The result of a check. Conditions that are not in `limits` hold with some margin, or cannot be judged.
struct LimitList
{
    static constexpr double near = 1.2;   ///< a condition with a margin below this (Condition::margin) is near its limit

    std::vector<Limit> limits {};     ///< broken ones first
    std::vector<Limit> unjudged {};   ///< those of which nothing is known, and of nodes that the hand does not reach
    std::vector<ContactLimit> contacts {};
    std::size_t held = 0, unknown = 0;   ///< how many other conditions hold, and how many cannot be judged
    std::size_t not_reached = 0;         ///< how many nodes the path of the hand does not reach, so that nothing about them is judged
    bool is_checked = false;             ///< false if the graph has not been checked, has errors, or drives no device

    std::size_t broken() const noexcept;
    Messages messages (const graph::Graph&) const;   ///< one for each limit: an error if broken, else a warning. Ids: limit/ID
    Messages remarks (const graph::Graph&) const;    ///< a warning for each that is not judged, with the same ids

    bool operator== (const LimitList&) const = default;
};

/// Measures the graph as `tactus check` does, and judges its conditions: the same graph gets the same verdicts each time. Takes a tenth of a second to a few
/// seconds, longer on a busy computer. The list is empty if it is stopped before.
/// [any thread that owns the assets]
LimitList limitsOf (const LimitJob&, const Catalogue&, FileAssets&, std::stop_token = {});

}   // namespace tactus::host
