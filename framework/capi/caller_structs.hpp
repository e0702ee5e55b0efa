// SPDX-License-Identifier: MIT
#pragma once

/// Structs that the caller fills, or that it has filled. Each begins with its size, so that it can grow at its end.

#include "tactus.h"

#include <tactus/text/message.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

struct tactus_messages
{
    tactus::Messages list;
};

namespace tactus::capi
{

/// The facts about a struct that are the same in every version of the library.
struct Form
{
    std::size_t first = 0;   ///< size up to the last member of the first version
    const char *name = "", *initialiser = "";
};

template <typename T>
inline constexpr Form form_of {};
template <>
inline constexpr Form form_of<tactus_message> { offsetof (tactus_message, column) + sizeof (std::int32_t), "tactus_message", "TACTUS_MESSAGE" };
template <>
inline constexpr Form form_of<tactus_run_options> { offsetof (tactus_run_options, set_count) + sizeof (std::size_t), "tactus_run_options",
                                                    "TACTUS_RUN_OPTIONS" };
template <>
inline constexpr Form form_of<tactus_reading> { offsetof (tactus_reading, signals) + TACTUS_CHANNELS * sizeof (double), "tactus_reading", "TACTUS_READING" };
template <>
inline constexpr Form form_of<tactus_effort> { offsetof (tactus_effort, signals) + TACTUS_CHANNELS * sizeof (double), "tactus_effort", "TACTUS_EFFORT" };
template <>
inline constexpr Form form_of<tactus_device_options> { offsetof (tactus_device_options, guard) + sizeof (char*), "tactus_device_options",
                                                       "TACTUS_DEVICE_OPTIONS" };
template <>
inline constexpr Form form_of<tactus_start_options> { offsetof (tactus_start_options, buffer) + sizeof (std::size_t), "tactus_start_options",
                                                      "TACTUS_START_OPTIONS" };
template <>
inline constexpr Form form_of<tactus_status> { offsetof (tactus_status, is_emergency) + sizeof (std::int32_t), "tactus_status", "TACTUS_STATUS" };
template <>
inline constexpr Form form_of<tactus_guard> { offsetof (tactus_guard, stops) + sizeof (std::uint64_t), "tactus_guard", "TACTUS_GUARD" };
template <>
inline constexpr Form form_of<tactus_control> { offsetof (tactus_control, value) + sizeof (double), "tactus_control", "TACTUS_CONTROL" };

/// Returns TACTUS_MISUSE, and keeps the reason for tactus_last_misuse. Allocates nothing.
tactus_result misuse (const char* why) noexcept;

/// False, with the reasons, if the size of a struct is none that this library and the versions before it have: then it is not initialised, or the
/// program was built against a newer version. Null is the caller's decision.
bool hasSize (const Form&, std::uint32_t size, std::size_t known, tactus_messages*) noexcept;

template <typename T>
bool isSized (const T* given, tactus_messages* messages = nullptr) noexcept
{
    static_assert (form_of<T>.first > 0);
    return given == nullptr || hasSize (form_of<T>, given->size, sizeof (T), messages);
}

/// The members of a sized struct of the caller that this version knows. A caller compiled against an older version has fewer.
template <typename T>
T known (const T* given, T defaults = {})
{
    if (given == nullptr) return defaults;
    std::memcpy (&defaults, given, std::min<std::size_t> (given->size, sizeof (T)));
    return defaults;
}

/// Fills a struct of the caller, up to the last member that the caller's version has. TACTUS_MISUSE if its size is wrong.
template <typename T>
tactus_result give (T* to, const T& from)
{
    if (to == nullptr) return misuse ("the struct to fill is NULL");
    if (! isSized (to)) return TACTUS_MISUSE;
    const auto size = to->size;
    std::memcpy (to, &from, std::min<std::size_t> (size, sizeof (T)));
    to->size = size;
    return TACTUS_OK;
}

}   // namespace tactus::capi
