// SPDX-License-Identifier: MIT
#include "content_hash.hpp"

#include <tactus/file/text_file.hpp>

#include <cstdint>
#include <fstream>
#include <iterator>

namespace tactus
{

std::string contentHash (std::string_view bytes)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : bytes)
        hash = (hash ^ static_cast<unsigned char> (c)) * 0x100000001b3u;

    std::string text (16, '0');
    for (std::size_t i = text.size(); i-- > 0; hash >>= 4u)
        text[i] = "0123456789abcdef"[hash & 15u];
    return text;
}

std::optional<std::string> fileHash (const std::filesystem::path& path)
{
    if (! whyUnreadable (path).empty()) return std::nullopt;
    std::ifstream in (path, std::ios::binary);
    const std::string bytes { std::istreambuf_iterator<char> (in), {} };
    return in ? std::optional (contentHash (bytes)) : std::nullopt;
}

}   // namespace tactus
