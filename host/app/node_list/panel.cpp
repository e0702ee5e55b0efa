// SPDX-License-Identifier: GPL-3.0-or-later
// The list of nodes in the window.
#include "node_list.hpp"

#include <host/app/desk/panel.hpp>
#include <host/app/text/filled.hpp>

#include <utility>

namespace tactus::host
{

Panel nodesPanel (Desk& desk)
{
    auto made = std::make_unique<NodeList>();
    auto* list = made.get();
    list->onSearch = [&desk] (const std::string& query) { return searchPalette (query, desk.document.graph(), desk.types, {}, {}, desk.canvas.patch()); };
    list->onAdd = [&desk] (const std::string& type) { desk.addNode (type); };
    list->onLeave = [&desk] { desk.leave(); };
    const auto refresh = [&desk, list, listed = std::pair (desk.document.version(), desk.canvas.patch())]() mutable {
        const std::pair now (desk.document.version(), desk.canvas.patch());
        if (std::exchange (listed, now) != now) list->refresh();
    };
    return { .name = TRANS ("Nodes"), .component = std::move (made), .refresh = refresh };
}

}   // namespace tactus::host
