// SPDX-License-Identifier: MIT
#pragma once

#include "json_text.hpp"

#include <optional>
#include <string_view>

namespace tactus
{

/// Reads valid JSON in one pass. Nearly all files are valid, and readJson would spend most of its time on being able to explain what is
/// wrong. Returns nullopt if the text is not JSON, has a key twice or exceeds a limit. What it accepts, it reads as readJson does.
/// [any thread]
std::optional<JsonText> readValidJson (std::string_view text, double most_values);

/// Reads any text, with a parser that reports each event, so that a message can say what is wrong and where. [any thread]
JsonText readAnyJson (std::string_view text, double most_values);

}   // namespace tactus
