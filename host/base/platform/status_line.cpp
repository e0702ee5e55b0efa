// SPDX-License-Identifier: MIT
#include "status_line.hpp"

#include <algorithm>

namespace tactus::host
{

namespace
{
bool startsLetter (char c) noexcept { return (c & 0xc0) != 0x80; }   // in UTF-8

int lettersIn (const std::string& text) { return static_cast<int> (std::ranges::count_if (text, startsLetter)); }

std::string joined (const std::vector<StatusPart>& parts)
{
    std::string line;
    for (const auto& part : parts)
        line += part.text;
    return line;
}
}   // namespace

std::string statusLine (std::vector<StatusPart> parts, int columns)
{
    auto line = joined (parts);
    if (columns <= 1) return line;
    const int room = columns - 1;   // some terminals wrap as soon as the last column is used
    for (; lettersIn (line) > room; line = joined (parts))
    {
        const auto least = std::ranges::max_element (parts, {}, &StatusPart::rank);
        if (least == parts.end() || least->rank == 0) break;
        parts.erase (least);
    }
    if (lettersIn (line) <= room) return line;
    auto end = line.begin();
    for (int letters = 0; end != line.end(); ++end)
        if (startsLetter (*end) && ++letters > room - 1) break;
    return std::string (line.begin(), end) + "…";
}

}   // namespace tactus::host
