// SPDX-License-Identifier: MIT
#include "meant.hpp"

#include "endpoint_text.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>

namespace tactus::graph
{

namespace
{
constexpr std::size_t longest = 200;   // text that is longer is not a slip of the finger

std::string inLowerCase (std::string_view text)
{
    std::string lower (text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char> (c - 'A' + 'a');
    return lower;
}

/// Text with what people write for an arrow replaced by one: => --> - > and the arrows and dashes of Unicode.
std::string withArrows (std::string_view text)
{
    constexpr std::array<std::string_view, 9> strokes { "\u2192", "\u21D2", "\u2013", "\u2014", "\u2212", "-", "=", ">", "~" };
    std::string result;
    bool in_arrow = false;
    while (! text.empty())
    {
        const auto stroke = std::ranges::find_if (strokes, [&] (std::string_view s) { return text.starts_with (s); });
        const bool is_stroke = stroke != strokes.end();
        if (is_stroke && ! in_arrow) result += " -> ";
        if (! is_stroke) result += text.front();
        text.remove_prefix (is_stroke ? stroke->size() : 1);
        in_arrow = is_stroke;
    }
    return result;
}

/// "grain/wave.phase" for "grain.wave.phase", in both ends of a wire.
std::string withPaths (const std::string& text)
{
    std::string result;
    for (std::size_t begin = 0; begin <= text.size();)
    {
        const auto end = std::min (text.find ("->", begin), text.size());
        auto part = text.substr (begin, end - begin);
        if (const auto last = part.rfind ('.'); last != part.npos && ! parseEndpoint (part))
            std::replace (part.begin(), part.begin() + static_cast<std::ptrdiff_t> (last), '.', '/');
        result += part;
        if (end < text.size()) result += "->";
        begin = end + 2;
    }
    return result;
}
}   // namespace

std::string idRemedy (std::string_view text)
{
    const std::string rule = "ids consist of lower-case letters, digits and _, and begin with a letter";
    if (text.size() > longest) return rule;
    auto id = inLowerCase (text);
    std::ranges::replace_if (
        id, [] (char c) { return ! (c >= 'a' && c <= 'z') && ! (c >= '0' && c <= '9'); }, '_');
    id.erase (0, std::min (id.find_first_not_of ("_0123456789"), id.size()));
    id.erase (id.find_last_not_of ('_') + 1);
    return isId (id) ? "write " + quote (id) + ": " + rule : rule;
}

std::string wireRemedy (std::string_view text)
{
    constexpr auto form = "write \"node.port -> node.port\"";
    if (text.size() > longest) return form;
    std::string meant (text);
    for (const auto& correct : { +[] (const std::string& t) { return withArrows (t); }, +[] (const std::string& t) { return withPaths (t); },
                                 +[] (const std::string& t) { return inLowerCase (t); } })
    {
        meant = correct (meant);
        if (const auto wire = parseWire (meant)) return "write \"" + toText (*wire) + '"';
    }
    if (meant.find ('[') != meant.npos) return "write \"node.port -> [1] -> node.port\" for a delay of one tick";
    return meant.find ("->") != meant.rfind ("->") ? "write each wire as a string of its own: \"node.port -> node.port\"" : form;
}

}   // namespace tactus::graph
