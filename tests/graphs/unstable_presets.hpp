// SPDX-License-Identifier: MIT
// The presets whose tool does not come to rest on their own device.
#pragma once

#include <map>
#include <string>

namespace tactus::test
{
/// By the name of the file: why the preset stays as it is. checked_presets_test.cpp compares the list with the check and with a simulation.
inline const std::map<std::string, std::string> unstable_presets {
    { "notched_rail", "without a hand, each click lifts a slider that is pressed lightly, and it drops back into a notch and clicks again" },
};
}   // namespace tactus::test
