// SPDX-License-Identifier: MIT
#include "bitcode.hpp"

#include <algorithm>
#include <cctype>

namespace tactus::host
{

std::string_view findBitcode (std::string_view header) noexcept
{
    const auto all = allBitcode();
    const auto found = std::ranges::find (all, header, &Bitcode::header);
    return found != all.end() ? found->bytes : std::string_view {};
}

std::string bitcodeName (std::string_view function, std::string_view header)
{
    constexpr std::string_view folder = "tactus/nodes/";
    auto name = "tactus_fused_" + std::string (function) + "_" + std::string (header.substr (std::min (folder.size(), header.size())));
    for (char& c : name)
        if (std::isalnum (static_cast<unsigned char> (c)) == 0) c = '_';
    return name;
}

}   // namespace tactus::host
