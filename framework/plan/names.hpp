// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::plan
{

/// Numbers names from 0 in the order they come in, and finds them again. The names of a large patch lie anywhere in
/// memory; here they are side by side, and one that is looked up is mostly in the cache.
class Names
{
public:
    static constexpr std::size_t none = ~std::size_t {};

    /// The number of a name; one that is known keeps its number.
    std::size_t add (std::string_view);

    /// `none` if it is not known.
    std::size_t find (std::string_view) const noexcept;

    std::size_t size() const noexcept { return begins.size() - 1; }

private:
    struct Entry
    {
        std::uint32_t hash = 0;
        std::uint32_t number_and_1 = 0;   // 0: free
    };

    std::string_view name (std::size_t number) const noexcept { return std::string_view (text).substr (begins[number], begins[number + 1] - begins[number]); }
    std::size_t placeOf (std::string_view, std::uint32_t hash) const noexcept;   // in the table: its own, or the free one for it
    void grow();

    std::string text;                                    // of all, one after another
    std::vector<std::size_t> begins { 0 };               // of each, and the end
    std::vector<Entry> table = std::vector<Entry> (8);   // a power of two of them, never more than half taken
};

}   // namespace tactus::plan
