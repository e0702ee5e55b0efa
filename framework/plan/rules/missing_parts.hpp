// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/plan.hpp>

#include <tactus/text/message.hpp>

namespace tactus
{

/// Returns a warning (device/missing_part) for each part that a node is set to but the device of its role does not have.
/// Reports each part once. Such a node reads 0, or has no effect. Call it when the roles have their devices (Engine::attach,
/// Engine::submit). [main thread]
Messages missingParts (const Plan&);

}   // namespace tactus
