// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/setting.hpp>

namespace tactus::plan
{

/// True if all settings have the same content. Files that were read again are compared by content too.
bool same (const Values&, const Values&);

}   // namespace tactus::plan
