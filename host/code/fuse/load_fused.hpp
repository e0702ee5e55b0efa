// SPDX-License-Identifier: MIT
#pragma once

#include "fused_code.hpp"

#include <tactus/plan/steps/fused_tick.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>
#include <memory>
#include <vector>

namespace tactus::host
{

/// Loads code that has been made for a plan. The code stays loaded until the program ends, because nodes may keep addresses in
/// it. Ids: fuse/cannot_load. [main thread]
Result<std::shared_ptr<const FusedTick>> loadFused (const std::filesystem::path&, std::vector<void*> objects, const char* function = FusedCode::function);

}   // namespace tactus::host
