// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/assets/file_assets.hpp>
#include <host/devices/hid_link/profile_library.hpp>
#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/plan/plan.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// The device and the hand with which a role of the graph is checked.
struct CheckedRole
{
    check::RoleDevice device;
    std::optional<check::HandChoice> hand {};   // empty: the hand that the graph describes
};

/// A graph with the devices and the hands with which it is checked: those that it describes, or that --device options name. The constructor reads and
/// compiles it. Constructor and motion() report what is wrong with the graph, its values and the options, and end the command if it is an error.
class CheckedGraph
{
public:
    CheckedGraph (const std::string& file, const std::vector<std::string>& devices, const std::vector<std::string>& sets, double rate_hz);

    CheckedGraph (const CheckedGraph&) = delete;
    CheckedGraph& operator= (const CheckedGraph&) = delete;

    /// The hands move once. `duration_s` 0: as long as their longest path.
    check::HandMotion motion (double duration_s) const;

    /// Each device moves once through its workspace, or through a box of 10 cm around the origin. `duration_s` 0: 4 s.
    check::HandMotion sweep (double duration_s) const;

    const std::string file;
    const LoadedGraph loaded;
    const hid::LoadedProfiles profiles;
    FileAssets assets;
    const check::Subject subject;
    const std::shared_ptr<Plan> plan;
    const std::vector<CheckedRole> roles;

private:
    void refuseErrors (const Messages&) const;
    check::HandMotion bounded (check::RecordedMotion) const;
};

}   // namespace tactus::host
