// SPDX-License-Identifier: MIT
#pragma once

#include <framework/setting.hpp>

namespace tactus::plan
{

/// True if all settings have the same content, also where files were read again.
bool same (const Values&, const Values&);

}   // namespace tactus::plan
