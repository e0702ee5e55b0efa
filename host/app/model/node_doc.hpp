// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// A part of what a node's header says of it.
struct DocPart
{
    enum class Kind
    {
        text,
        formula,   ///< a line of the law, with its spaces
        heading,
        item   ///< of a list
    };

    Kind kind = Kind::text;
    std::string text;
};

/// The doc block of a node's header, whose words were taken in when the program was built; empty for another type.
std::vector<DocPart> docOf (std::string_view type);

/// Its law: the formulas that come before the source.
std::vector<std::string> lawOf (std::string_view type);

/// A doc block in parts.
std::vector<DocPart> readDoc (std::string_view);

}   // namespace tactus::host
