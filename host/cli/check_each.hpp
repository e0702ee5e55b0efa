// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "report.hpp"

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

namespace tactus::host
{

/// Checks each of these files, and prints how many of several are fine: "2 of 3 tests pass". Ends the command with status 1 if one of them is not.
template <typename F>
void checkEach (const std::vector<std::string>& files, const char* are_fine, F&& isFine)
{
    const auto fine = static_cast<std::size_t> (std::ranges::count_if (files, isFine));
    if (files.size() > 1) std::cout << fine << " of " << files.size() << " " << are_fine << "\n";
    if (fine < files.size()) throw Stop {};
}

}   // namespace tactus::host
