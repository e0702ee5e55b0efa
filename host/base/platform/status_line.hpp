// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace tactus::host
{

/// A part of a status line. Parts of the highest rank are left out first; those of rank 0 never are.
struct StatusPart
{
    std::string text;
    int rank = 0;
};

/// Joins the parts that fit a terminal row of this many characters, so that the next status can replace the line. What is still too long
/// ends in an ellipsis. 0 columns: everything fits.
std::string statusLine (std::vector<StatusPart>, int columns);

}   // namespace tactus::host
