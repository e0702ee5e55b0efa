// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/prepared_data.hpp>

namespace tactus::plan
{

/// The prepared data of all plans of this process.
PreparedData& preparedOfAll();

}   // namespace tactus::plan
