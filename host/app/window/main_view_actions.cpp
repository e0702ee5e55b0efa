// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that a click can do, found by its name, so that nothing needs the mouse.
#include "main_view.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/key_text.hpp>
#include <host/app/model/readable.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

struct MainView::Action
{
    juce::String name, about;
    std::function<void()> act;
};

namespace
{
template <typename Actions>
void addItems (const juce::PopupMenu& menu, const juce::String& before, Actions& all)
{
    for (juce::PopupMenu::MenuItemIterator i (menu); i.next();)
    {
        const auto& item = i.getItem();
        if (item.subMenu != nullptr)
            addItems (*item.subMenu, item.text + ": ", all);
        else if (item.isEnabled && item.action)
            all.push_back ({ before + item.text, item.shortcutKeyDescription, item.action });
    }
}

/// Calls f with each button in a part of the window that can be clicked, or could be if its tab was in front, and with that tab's panel.
template <typename F>
void forButtons (juce::Component& in, juce::Component* panel, const F& f)
{
    if (auto* b = dynamic_cast<juce::Button*> (&in); b != nullptr && b->isEnabled()) f (*b, panel);
    const bool has_tabs = dynamic_cast<Tabs*> (&in) != nullptr;
    for (auto* child : in.getChildren())
        if (has_tabs || child->isVisible()) forButtons (*child, has_tabs ? child : panel, f);
}

juce::String nameOf (const juce::Button& b) { return b.getTitle().isNotEmpty() ? b.getTitle() : b.getButtonText(); }

void press (juce::Component& in, const juce::String& name)
{
    juce::Button* found = nullptr;
    forButtons (in, nullptr, [&] (juce::Button& b, juce::Component*) {
        if (found == nullptr && nameOf (b) == name) found = &b;
    });
    if (found != nullptr) found->triggerClick();
}
}   // namespace

void MainView::reveal (Tabs& tabs, const juce::Component& panel)
{
    if (auto& edge = &tabs == &left ? left_edge : bottom_edge; edge.isFolded())
    {
        edge.fold (false);
        edgeMoved();
        panelsMoved();
    }
    if (&tabs == &left) turnTo (left);
    tabs.show (panel);
}

/// What can be done to the parameters of the selected node, and the commands of the canvas.
void MainView::addEdits (std::vector<Action>& all)
{
    if (! patching.isShowing() || welcome.isVisible()) return;
    if (const auto nodes = patching.commands().selectedNodes(); nodes.size() == 1)
        for (const auto& p : nodes[0]->face->params)
        {
            juce::PopupMenu menu;
            inspector.fillParamMenu (menu, nodes[0]->name, p.id);
            addItems (menu, fromUtf8 (readableName (p)) + ": ", all);
        }
    for (const auto& c : canvasCommands())
        if (c.in_menu && c.can (patching))
        {
            const auto keys = keyText (juce::String (c.keys).upToFirstOccurrenceOf ("|", false, false));
            all.push_back ({ juce::translate (c.name), keys, [this, &c] { c.run (patching); } });
        }
}

void MainView::addTabsAndButtons (std::vector<Action>& all)
{
    if (isSmall())
        for (const auto& [name, part] : pageParts())
            all.push_back ({ juce::translate (name), TRANS ("A page"), [this, shown = part] { turnTo (*shown); } });
    for (auto* tabs : { &bottom, &left })
        for (int i = 0; const auto& [name, place] : tabs->titles())
            all.push_back ({ name, TRANS ("A panel"), [this, tabs, i = i++] { reveal (*tabs, *tabs->panel (i)); } });
    forButtons (*this, nullptr, [&] (juce::Button& b, juce::Component* panel) {
        auto* tabs = panel == nullptr ? nullptr : dynamic_cast<Tabs*> (panel->getParentComponent());
        const auto act = [this, name = nameOf (b), panel, tabs] {
            if (tabs != nullptr) reveal (*tabs, *panel);
            press (tabs != nullptr ? *panel : *this, name);
        };
        all.push_back ({ nameOf (b), b.getTooltip(), act });
    });
}

void MainView::findAction()
{
    std::vector<Action> all;
    addEdits (all);
    addTabsAndButtons (all);
    addItems (windowMenu(), {}, all);
    std::vector<PaletteEntry> entries;
    for (const auto& a : all)
        if (const auto name = a.name.toStdString(); ! name.empty() && std::ranges::count (entries, name, &PaletteEntry::type) == 0)
            entries.push_back ({ name, {}, a.about.toStdString() });
    const auto search = [entries] (const std::string& query) { return matching (entries, query); };
    const auto choose = [this, all] (const std::string& chosen) {
        takeFocus (keyboardHome());
        const auto found = std::ranges::find (all, fromUtf8 (chosen), &Action::name);
        if (found != all.end()) found->act();
    };
    palette.open ({ (getWidth() - Palette::width) / 2, top.getBottom() }, search, TRANS ("Find a command, a button or a panel"), choose,
                  Palette::Finds::others);
}

}   // namespace tactus::host
