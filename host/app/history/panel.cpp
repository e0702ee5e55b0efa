// SPDX-License-Identifier: GPL-3.0-or-later
// The list of steps in the window.
#include "history_panel.hpp"

#include <host/app/desk/panel.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

Panel historyPanel (Desk& desk) { return { .name = TRANS ("History"), .component = std::make_unique<HistoryPanel> (desk.document) }; }

}   // namespace tactus::host
