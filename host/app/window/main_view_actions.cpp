// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that a click can do, and the nodes of the graph, found by their names, so that nothing needs the mouse.
#include "main_view.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/key_text.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/model/readable.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace tactus::host
{

struct MainView::Action
{
    juce::String name, about;
    std::function<void()> act;
    std::string key {};                  // what the list calls it; empty: its name
    std::vector<Findable> searched {};   // it is found as the best of them; empty: by its name, and by what is said about it
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

/// Calls f with the row of tabs of a panel.
void MainView::withTabs (const juce::Component& panel, const std::function<void (Tabs&)>& f)
{
    for (const auto& p : panels)
        if (&p.component == &panel && p.tabs != nullptr) f (*p.tabs);
}

/// Adds the actions for the parameters of the selected node, and the commands of the canvas.
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

/// Adds the choices for what moves the tool.
void MainView::addHands (std::vector<Action>& all)
{
    if (welcome.isVisible()) return;
    for (auto& [name, choose] : hand.choices())
        all.push_back ({ name, TRANS ("What moves the tool"), std::move (choose) });
}

/// Adds the nodes of all patches that can be shown, in the order of the list of nodes to add. A node is found by its name, and as its type is found there.
void MainView::addNodes (std::vector<Action>& all)
{
    if (welcome.isVisible()) return;
    const auto types = paletteTypes (edited.graph(), catalogue);
    std::vector<std::pair<std::size_t, Action>> found;   // with the number of the type
    std::vector<std::string> patches { {} };
    for (std::size_t i = 0; i < patches.size(); ++i)
    {
        const auto in = patches[i];
        const auto* patch = findPatch (edited.graph(), in);
        if (patch == nullptr) continue;
        for (const auto& n : patch->nodes)
        {
            if (n.type.starts_with ("graph:") && std::ranges::count (patches, n.type.substr (6)) == 0) patches.push_back (n.type.substr (6));
            const auto path = in.empty() ? n.name : in + '/' + n.name;
            const auto type = std::ranges::find (types, n.type, [] (const PaletteType& t) { return t.entry.type; });
            std::vector<Findable> searched { { n.name, path + ' ' + n.type, {}, {} } };
            if (type != types.end()) searched.push_back (type->searched);
            const auto about = filled (TRANS ("A node of this graph: %1"), type == types.end() ? n.type : type->entry.name);
            const auto show = [this, in, id = n.id] {
                turnTo (patching);
                patching.show (in, id);
                if (const auto* node = patching.scene().find (id)) patching.bringIntoView (node->bounds());
            };
            Action way { fromUtf8 (path), about, show, n.type + " (" + path + ')', std::move (searched) };
            found.emplace_back (static_cast<std::size_t> (type - types.begin()), std::move (way));
        }
    }
    std::ranges::stable_sort (found, {}, [] (const auto& f) { return f.first; });
    for (auto& f : found)
        all.push_back (std::move (f.second));
}

void MainView::findAction()
{
    std::vector<Action> all;
    addEdits (all);
    addHands (all);
    addTabsAndButtons (all);
    addItems (windowMenu(), {}, all);
    addNodes (all);
    for (const auto& p : panels)
        if (p.panel.actions && ! welcome.isVisible())
            for (auto& a : p.panel.actions())
                all.push_back ({ std::move (a.name), std::move (a.about), std::move (a.act) });
    std::map<std::string, std::function<void()>> acts;
    std::vector<PaletteEntry> entries;
    std::vector<Findable> searched;
    std::vector<std::size_t> entry_of;   // by the number in `searched`
    for (auto& a : all)
    {
        const auto name = a.name.toStdString(), about = a.about.toStdString();
        const auto& key = a.key.empty() ? name : a.key;
        if (key.empty() || ! acts.try_emplace (key, a.act).second) continue;
        if (a.searched.empty()) a.searched.push_back ({ name, {}, {}, about });
        for (auto& f : a.searched)
        {
            searched.push_back (std::move (f));
            entry_of.push_back (entries.size());
        }
        entries.push_back ({ key, name, about });
    }
    const auto search = [entries, searched, entry_of] (const std::string& query) {
        std::vector<PaletteEntry> found;
        std::set<std::size_t> seen;
        for (const auto i : bestMatches (searched, query))
            if (seen.insert (entry_of[i]).second) found.push_back (entries[entry_of[i]]);
        return found;
    };
    const auto choose = [this, acts] (const std::string& chosen) {
        takeFocus (keyboardHome());
        if (const auto found = acts.find (chosen); found != acts.end()) found->second();
    };
    palette.open ({ (getWidth() - Palette::width) / 2, top.getBottom() }, search, TRANS ("Find a node of this graph, a command, a button or a panel"), choose,
                  Palette::Finds::others);
}

}   // namespace tactus::host
