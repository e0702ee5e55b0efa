// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/desk/panel.hpp>

namespace tactus::host
{

Panel wiresPanel (Desk&);   ///< the panel of docs/panels.md

}   // namespace tactus::host
