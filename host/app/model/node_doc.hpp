// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// One part of the doc comment of a node's header.
struct DocPart
{
    enum class Kind
    {
        text,
        formula,   ///< a line of the law, spaces included
        heading,
        item   ///< a list item
    };

    Kind kind = Kind::text;
    std::string text;
};

/// The doc comment of a node's header, embedded at build time. Empty for an unknown type.
std::vector<DocPart> docOf (std::string_view type);

/// The node's law: the formulas of its doc comment that come before "Source:".
std::vector<std::string> lawOf (std::string_view type);

/// Splits a doc comment into parts.
std::vector<DocPart> readDoc (std::string_view);

}   // namespace tactus::host
