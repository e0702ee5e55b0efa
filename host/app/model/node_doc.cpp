// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_doc.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

namespace tactus::host
{

/// CMake generates it from the headers in nodes/.
extern const std::vector<std::pair<std::string_view, std::string_view>> node_docs;

std::vector<DocPart> readDoc (std::string_view doc)
{
    std::vector<DocPart> parts;
    bool continues = false;   // true if this line continues the last part
    std::istringstream lines { std::string (doc) };
    for (std::string line; std::getline (lines, line);)
    {
        const auto begin = line.find_first_not_of (' ');
        if (begin == std::string::npos)
        {
            continues = false;
            continue;
        }
        const auto words = line.substr (begin);
        constexpr std::size_t formula_indent = 4;
        if (begin >= formula_indent)
        {
            parts.push_back ({ DocPart::Kind::formula, line.substr (formula_indent) });
            continues = false;
        }
        else if (words.starts_with ("- "))
        {
            // The text line right above a list is its heading.
            if (! parts.empty() && continues && parts.back().kind == DocPart::Kind::text) parts.back().kind = DocPart::Kind::heading;
            parts.push_back ({ DocPart::Kind::item, words.substr (2) });
            continues = true;
        }
        else if (continues)
            parts.back().text += ' ' + words;
        else
        {
            parts.push_back ({ DocPart::Kind::text, words });
            continues = true;
        }
    }
    return parts;
}

std::vector<DocPart> docOf (std::string_view type)
{
    const auto found = std::ranges::find (node_docs, type, &std::pair<std::string_view, std::string_view>::first);
    return found == node_docs.end() ? std::vector<DocPart> {} : readDoc (found->second);
}

std::vector<std::string> lawOf (std::string_view type)
{
    std::vector<std::string> law;
    for (const auto& part : docOf (type))
    {
        if (part.text.starts_with ("Source:")) break;
        if (part.kind == DocPart::Kind::formula) law.push_back (part.text);
    }
    return law;
}

}   // namespace tactus::host
