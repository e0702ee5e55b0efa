// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_plugin.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace tactus::plugin
{

/// Copies the members that both sides know. The others are 0.
template <typename T>
void copyKnown (T& to, const T* from) noexcept
{
    static_assert (std::is_trivially_copyable_v<T>);
    to = {};
    std::memcpy (&to, from, std::min<std::size_t> (from->size, sizeof to));
    to.size = sizeof to;
}

/// The size of a struct up to the last member of the first version of the interface. It stays the same when members are added, so that
/// plugins of the first version can still be loaded. Later members are read only through copyKnown, or if the size covers them.
template <typename T>
inline constexpr std::size_t first_size = 0;
template <>
inline constexpr std::size_t first_size<tactus_plugin_unit> = offsetof (tactus_plugin_unit, adds_up) + sizeof (std::int32_t);
template <>
inline constexpr std::size_t first_size<tactus_plugin_limits> = offsetof (tactus_plugin_limits, usual_max) + sizeof (double);
template <>
inline constexpr std::size_t first_size<tactus_plugin_port> = offsetof (tactus_plugin_port, initial) + 3 * sizeof (double);
template <>
inline constexpr std::size_t first_size<tactus_plugin_value> = offsetof (tactus_plugin_value, asset) + sizeof (void*);
template <>
inline constexpr std::size_t first_size<tactus_plugin_setting> = offsetof (tactus_plugin_setting, initial) + sizeof (void*);
template <>
inline constexpr std::size_t first_size<tactus_plugin_node> = offsetof (tactus_plugin_node, learn) + sizeof (void (*)());
template <>
inline constexpr std::size_t first_size<tactus_plugin_appearance> = offsetof (tactus_plugin_appearance, part_count) + sizeof (std::size_t);
template <>
inline constexpr std::size_t first_size<tactus_plugin> = offsetof (tactus_plugin, extension) + sizeof (void (*)());

/// True if the plugin provides this struct, with all members of the first version of the interface.
template <typename T>
bool isWhole (const T* given) noexcept
{
    static_assert (first_size<T> > 0);
    return given != nullptr && given->size >= first_size<T>;
}

}   // namespace tactus::plugin
