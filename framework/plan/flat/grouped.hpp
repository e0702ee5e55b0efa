// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace tactus::plan
{

/// Items sorted into numbered groups, stored side by side in one list. Within a group they keep the order they arrived in.
template <typename T>
class Grouped
{
public:
    /// Calls `forEach` twice with a visitor, which must be called with (group, item) for each item, in the same order both times.
    template <typename ForEach>
    Grouped (std::size_t groups, const ForEach& forEach) : first (groups + 1, 0)
    {
        // While items are being added, first[g + 1] is the index for the next item of group g. At the end it is the index where
        // group g + 1 begins.
        const auto entry = [this] (auto group) -> std::size_t& { return first[static_cast<std::size_t> (group) + 1]; };
        forEach ([&] (auto group, const T&) { ++entry (group); });
        std::size_t end = 0;
        for (auto& f : first)
            end += std::exchange (f, end);
        all.resize (end);
        forEach ([&] (auto group, const T& item) { all[entry (group)++] = item; });
    }

    std::span<const T> operator[] (std::size_t group) const noexcept { return { all.data() + first[group], all.data() + first[group + 1] }; }
    std::span<T> operator[] (std::size_t group) noexcept { return { all.data() + first[group], all.data() + first[group + 1] }; }

private:
    std::vector<T> all;
    std::vector<std::size_t> first;   // index of the first item of each group, then the end
};

}   // namespace tactus::plan
