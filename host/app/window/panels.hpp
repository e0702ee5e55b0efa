// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/desk/panel.hpp>

namespace tactus::host
{

/// The panels of the window: their places, and the functions of their folders. Those at the left of the canvas and at the bottom are tabs, in this order;
/// those over it cover the window while they are visible. Nothing else in the host names a panel (tests/structure/rooms.py).
#define TACTUS_PANELS(PANEL)      \
    PANEL (left, presetsPanel)    \
    PANEL (left, nodesPanel)      \
    PANEL (left, historyPanel)    \
    PANEL (bottom, scopesPanel)   \
    PANEL (bottom, takesPanel)    \
    PANEL (bottom, layersPanel)   \
    PANEL (bottom, devicesPanel)  \
    PANEL (bottom, problemsPanel) \
    PANEL (over, fitPanel)

#define TACTUS_DECLARE(tabs, make) Panel make (Desk&);
TACTUS_PANELS (TACTUS_DECLARE)
#undef TACTUS_DECLARE

}   // namespace tactus::host
