// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::plan
{

/// Numbers names from 0 in the order they are added, and looks them up. Stores them side by side, so a lookup usually hits the
/// cache; the names in the nodes of a large Patch are scattered in memory.
class Names
{
public:
    static constexpr std::size_t none = ~std::size_t {};

    /// The number of a name. A name that was added before keeps its number.
    std::size_t add (std::string_view);

    /// The number of a name, or `none`.
    std::size_t find (std::string_view) const noexcept;

    std::size_t size() const noexcept { return begins.size() - 1; }

private:
    struct Entry
    {
        std::uint32_t hash = 0;
        std::uint32_t number_and_1 = 0;   // number of the name + 1; 0: the entry is free
    };

    std::string_view name (std::size_t number) const noexcept { return std::string_view (text).substr (begins[number], begins[number + 1] - begins[number]); }
    std::size_t placeOf (std::string_view, std::uint32_t hash) const noexcept;   // the name's entry in the table, or the free entry where it belongs
    void grow();

    std::string text;                                    // all names, one after another
    std::vector<std::size_t> begins { 0 };               // where each name begins, then the end
    std::vector<Entry> table = std::vector<Entry> (8);   // its size is a power of two; at most half of the entries are in use
};

}   // namespace tactus::plan
