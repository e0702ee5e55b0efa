// SPDX-License-Identifier: GPL-3.0-or-later
#include "axes_text.hpp"

#include <algorithm>
#include <sstream>

namespace tactus::host
{

std::string textOfAxes (const Json& axes)
{
    std::string text;
    if (! axes.is_array()) return axes.is_string() ? axes.asString() : axes.dump();
    for (const auto& axis : axes.asArray())
    {
        if (! axis.is_string()) return axes.dump();
        text += (text.empty() ? "" : " ") + axis.asString();
    }
    return text;
}

Json readAxesText (std::string_view text)
{
    if (auto json = Json::tryParse (text)) return *json;
    std::string words (text);
    std::ranges::replace (words, ',', ' ');
    std::istringstream in (words);
    Json axes = Json::array();
    for (std::string word; in >> word;)
        axes.push_back (word.starts_with ('+') ? word.substr (1) : word);
    return axes.size() == 3 ? axes : Json (std::string (text));
}

}   // namespace tactus::host
