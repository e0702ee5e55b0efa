// SPDX-License-Identifier: MIT
#pragma once

#include "plan.hpp"

#include <framework/message.hpp>

namespace tactus
{

/// A warning for each part that nodes of a plan are set to and the device of their role does not have, each once: to be asked
/// for once the roles have their devices (Engine::attach, Engine::submit). Such a node reads 0, or acts on nothing.
/// Id: device/missing_part. [main thread]
Messages missingParts (const Plan&);

}   // namespace tactus
