// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/list_text.hpp>

/// Pieces of C++ text.

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tactus::host
{

/// A number as C++ that reads back to the same bits: "0.4", "-1e-09", "tactus::inf". Every NaN becomes the same one.
std::string literal (double);

/// A text as a C++ string literal.
std::string textLiteral (std::string_view);

/// A text for a comment: in one line, so that it ends where it should.
std::string comment (std::string_view);

/// The text as an identifier: "finger[3]/drag.mu" becomes "finger_3_drag_mu".
std::string identifier (std::string_view);

/// "DryWood" for "dry_wood".
std::string className (std::string_view identifier);

/// Members of a struct, which come with their offsets, in the order in which an initializer lists them.
std::vector<std::string> inOrder (std::vector<std::pair<std::size_t, std::string>> members);

/// Code that begins with `head` and has these parts: on one line if it fits, else with one part per line. `end` closes it.
std::string wrapped (std::string_view indent, const std::string& head, const std::vector<std::string>& parts, std::string_view end);

/// A text in which each mark, such as @STEM@, is replaced by what belongs there. What takes the place of a mark is not searched for marks, because names
/// that users write may look like one. Where several marks fit, the first one counts.
std::string filled (std::string text, const std::vector<std::pair<std::string, std::string>>& marks);

/// Gives out names that are unique in their scope and are not words of C++.
class Names
{
public:
    /// These names are taken.
    explicit Names (std::set<std::string> taken = {}) : used (std::move (taken)) {}

    /// The identifier of this text, with a number if it is taken. The names that it forms with these endings are reserved, too.
    std::string make (std::string_view text, const std::vector<std::string>& endings = {});

private:
    std::set<std::string> used;
};

}   // namespace tactus::host
