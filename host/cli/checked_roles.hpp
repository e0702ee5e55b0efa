// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid_link/profile_library.hpp>
#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/plan/plan.hpp>

#include <filesystem>
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

/// The roles of a graph, each with the device and the hand that the graph describes, or that a --device option names. Ends the command if an option
/// is wrong.
std::vector<CheckedRole> checkedRoles (const Plan&, const LoadedGraph&, const std::filesystem::path& folder_of_graph, const std::vector<std::string>& options,
                                       const hid::LoadedProfiles&);

std::vector<check::HandChoice> handsOf (const std::vector<CheckedRole>&);
std::vector<check::Reach> reachesOf (const std::vector<CheckedRole>&);

}   // namespace tactus::host
