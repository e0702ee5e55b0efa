// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace tactus
{

/// JSON whose objects keep the order of the file, so that what is written diffs well against what was read.
using Json = nlohmann::ordered_json;

}   // namespace tactus
