// SPDX-License-Identifier: GPL-3.0-or-later
#include "setting_editor.hpp"

#include <host/app/look/focus.hpp>

#include <utility>

namespace tactus::host
{

void Stack::refresh (const graph::Node* node)
{
    if (auto now = shape(); made_for != now)
    {
        for (auto& b : blocks)
            letGoOfFocus (*b);
        for (auto& b : blocks)
            removeChildComponent (b.get());
        retired = std::exchange (blocks, {});
        made_for = std::move (now);
        fill();
        resized();
    }
    Column::refresh (node);
}

}   // namespace tactus::host
