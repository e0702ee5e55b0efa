// SPDX-License-Identifier: MIT
#pragma once

#include "judge.hpp"

#include <tactus/text/json.hpp>

namespace tactus::check
{

/// The report of `tactus check --json`, as docs/check.md describes it. Numbers that are not finite are null.
Json toJson (const Demand&, std::span<const RoleDevice>, std::span<const Condition>, const JudgeOptions&);

/// "M 0.1 kg, B 0.05 N*s/m, …": the known numbers of a device, with their symbols.
std::string describe (const DeviceNumbers&);

}   // namespace tactus::check
