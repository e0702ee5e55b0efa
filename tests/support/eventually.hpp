// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <thread>

namespace tactus::test
{

/// True as soon as the condition holds; false if it still does not hold after so long that no load of the computer explains it.
template <typename F>
bool eventually (F&& so, std::chrono::seconds longest = std::chrono::seconds (120))
{
    const auto end = std::chrono::steady_clock::now() + longest;
    while (! so())
    {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for (std::chrono::microseconds (200));
    }
    return true;
}

}   // namespace tactus::test
