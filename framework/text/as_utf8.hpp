// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace tactus
{

/// A text in UTF-16, which spreadsheets write, as UTF-8; any other text as it is. UTF-16 is known by its byte order mark, or by the zeros of its
/// first two letters. Half a pair of surrogates becomes U+FFFD. Time: linear. [any thread]
std::string asUtf8 (std::string_view bytes);

}   // namespace tactus
