// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid_link/profile_library.hpp>
#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/assets.hpp>
#include <tactus/plan/plan.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The device and the hand with which a role of the graph is checked.
struct CheckedRole
{
    check::RoleDevice device;
    std::optional<check::HandChoice> hand {};   // empty: the hand that the graph describes
};

/// A graph with the devices and the hands with which it is checked: those that it describes, or that texts as for the option --device name. The
/// constructor compiles it. Constructor, motion() and sweep() refuse the graph, its values and the texts if they are wrong.
class CheckedGraph
{
public:
    struct Options
    {
        std::vector<std::string> devices {};   ///< as for --device
        std::vector<plan::Override> overrides {};
        double rate_hz = 0.0;   ///< 0: that of the graph
    };

    /// `file` is named in messages; empty if the graph is in no file. The assets must outlive this object.
    CheckedGraph (LoadedGraph, std::string file, Assets&, const Options&);

    CheckedGraph (const CheckedGraph&) = delete;
    CheckedGraph& operator= (const CheckedGraph&) = delete;

    /// The hands move once. `duration_s` 0: as long as their longest path.
    check::HandMotion motion (double duration_s);

    /// Each device moves once through its workspace, or through a box of 10 cm around the origin. `duration_s` 0: 4 s.
    check::HandMotion sweep (double duration_s);

    /// Warnings that have not been returned yet.
    Messages takeWarnings() { return std::exchange (warnings, {}); }

private:
    Messages warnings;

public:
    const std::string file;
    const LoadedGraph loaded;
    const hid::LoadedProfiles profiles;
    const check::Subject subject;
    const std::shared_ptr<Plan> plan;
    const std::vector<CheckedRole> roles;

private:
    void refuseErrors (Messages);
    check::HandMotion bounded (check::RecordedMotion);
};

}   // namespace tactus::host
