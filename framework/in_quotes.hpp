// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace tactus
{

/// Text that somebody wrote, fit to stand in a sentence: in single quotes, cut when it is long, and with everything
/// that is not printable UTF-8 escaped, so that a broken file cannot break the message about it.
std::string inQuotes (std::string_view);

}   // namespace tactus
