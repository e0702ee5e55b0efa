// SPDX-License-Identifier: GPL-3.0-or-later
#include "readable.hpp"
#include "param_value.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace tactus::host
{

namespace
{
/// A word that is a symbol of the chapter, or that has its own spelling; "" for all others.
std::string_view spelling (std::string_view word)
{
    constexpr std::array<std::pair<std::string_view, std::string_view>, 8> known { {
        { "mu", "μ" },
        { "alpha", "α" },
        { "sigma", "σ" },
        { "db", "dB" },
        { "wav", "WAV" },
        { "csv", "CSV" },
        { "q", "Q" },
        { "lfo", "LFO" },
    } };
    const auto found = std::ranges::find (known, word, &std::pair<std::string_view, std::string_view>::first);
    return found == known.end() ? std::string_view {} : found->second;
}
}   // namespace

std::string readable (std::string_view id)
{
    std::string text;
    for (std::size_t begin = 0; begin <= id.size();)
    {
        const auto end = std::min (id.find ('_', begin), id.size());
        const auto word = id.substr (begin, end - begin);
        begin = end + 1;
        if (word.empty()) continue;
        const bool is_first = text.empty();
        if (! is_first) text += ' ';
        if (const auto own = spelling (word); ! own.empty())
        {
            text += own;
            continue;
        }
        text += word;
        const auto stem = word.substr (0, word.find ('['));
        if (is_first && stem.size() > 1) text[0] = static_cast<char> (std::toupper (static_cast<unsigned char> (text[0])));   // a single letter is a symbol
    }
    return text;
}

std::string nameWithId (std::string_view id)
{
    auto name = readable (id);
    const auto isSame = [] (char a, char b) { return std::tolower (static_cast<unsigned char> (a)) == std::tolower (static_cast<unsigned char> (b)); };
    return std::ranges::equal (name, id, isSame) ? name : name + " (" + std::string (id) + ')';
}

std::string readableName (const FacePort& port)
{
    return port.sheet != nullptr && baseOf (port.id) == port.sheet->id ? readable (port.id) : port.id;
}

}   // namespace tactus::host
