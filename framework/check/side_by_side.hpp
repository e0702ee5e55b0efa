// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/caught.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace tactus::check
{

/// Calls `work (i)` for each i from 0 to count - 1, on at most `threads` threads, this one included. The calls must be independent of each other. If calls
/// throw, rethrows the exception of the one with the lowest i, after all have ended.
template <typename Work>
void sideBySide (std::size_t count, std::size_t threads, Work&& work)
{
    std::vector<std::exception_ptr> thrown (count);
    std::atomic<std::size_t> next { 0 };
    const auto some = [&] {
        for (std::size_t i = next++; i < count; i = next++)
            try
            {
                work (i);
            }
            catch (...)
            {
                thrown[i] = std::current_exception();
            }
    };
    {
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < std::min (threads, count); ++i)
            others.emplace_back ([&] { static_cast<void> (caught ("the check", some)); });
        some();
    }
    for (const auto& e : thrown)
        if (e) std::rethrow_exception (e);
}

}   // namespace tactus::check
