// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace tactus::plan
{

/// Items sorted into numbered groups, side by side in one list; within a group they keep the order they came in.
template <typename T>
class Grouped
{
public:
    /// Calls `forEach` twice with a visitor, which it has to call with (group, item) for each item, both times alike.
    template <typename ForEach>
    Grouped (std::size_t groups, const ForEach& forEach) : first (groups + 1, 0)
    {
        // While items come in, each group's entry is where its next item goes: at last its end, where the next begins.
        const auto entry = [this] (auto group) -> std::size_t&
        { return first[static_cast<std::size_t> (group) + 1]; };
        forEach ([&] (auto group, const T&)
                 { ++entry (group); });
        std::size_t end = 0;
        for (auto& f : first)
            end += std::exchange (f, end);
        all.resize (end);
        forEach ([&] (auto group, const T& item)
                 { all[entry (group)++] = item; });
    }

    std::span<const T> operator[] (std::size_t group) const noexcept { return { all.data() + first[group], all.data() + first[group + 1] }; }
    std::span<T> operator[] (std::size_t group) noexcept { return { all.data() + first[group], all.data() + first[group + 1] }; }

private:
    std::vector<T> all;
    std::vector<std::size_t> first;   // of each group, and the end
};

}   // namespace tactus::plan
