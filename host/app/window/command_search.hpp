// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "keyboard.hpp"
#include "main_menu.hpp"

namespace tactus::host
{

/// The search for commands (Ctrl+K): everything that a click can do, and the nodes of the graph, found by their names, so that nothing needs the mouse.
/// [main thread]
class CommandSearch
{
public:
    CommandSearch (WindowParts& p, MainMenu& m, Keyboard& k) : parts (p), menu (m), keyboard (k) {}

    void open();

private:
    struct Action;   ///< what a click would do, or the way to a node
    void addEdits (std::vector<Action>&);
    void addChoices (std::vector<Action>&);
    void addTabsAndButtons (std::vector<Action>&);
    void addNodes (std::vector<Action>&);
    void addTypes (std::vector<Action>&);

    WindowParts& parts;
    MainMenu& menu;
    Keyboard& keyboard;
};

}   // namespace tactus::host
