// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_search.hpp"

#include <host/app/adding/node_palette.hpp>
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

struct CommandSearch::Action
{
    juce::String name, about;
    std::function<void()> act;
    std::string key {};                  // what the list calls it; empty: its name
    std::vector<Findable> searched {};   // it is found as the best of them; empty: by its name, and by what is said about it
    bool comes_last = false;             // after all that is in the graph and in the window
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
            addItems (*item.subMenu, before + item.text + ": ", all);
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

/// Adds the actions for the parameters of the selected node, and the commands of the canvas.
void CommandSearch::addEdits (std::vector<Action>& all)
{
    auto& patching = parts.patching;
    if (! patching.isShowing() || parts.welcome.isVisible()) return;
    if (const auto nodes = patching.commands().selectedNodes(); nodes.size() == 1)
        for (const auto& p : nodes[0]->face->params)
        {
            juce::PopupMenu menu;
            parts.inspector.fillParamMenu (menu, nodes[0]->name, p.id);
            addItems (menu, fromUtf8 (readableName (p)) + ": ", all);
        }
    for (const auto& c : canvasCommands())
        if (c.in_menu && c.can (patching))
        {
            const auto keys = keyText (juce::String (c.keys).upToFirstOccurrenceOf ("|", false, false));
            all.push_back ({ juce::translate (c.name), keys, [&patching, &c] { c.run (patching); } });
        }
}

/// Adds the knobs and their actions, what the menu of each snapshot offers, and the choices for what moves the tool.
void CommandSearch::addChoices (std::vector<Action>& all)
{
    if (parts.welcome.isVisible()) return;
    auto& knobs = parts.inspector.knobs();
    for (std::size_t i = 0; i < knobs.size(); ++i)
    {
        const auto focus = [this, i] {
            parts.turnTo (parts.inspector);
            if (i < parts.inspector.knobs().size()) takeFocus (parts.inspector.knobs().knob (i));
        };
        const auto about = TRANS ("A knob: the arrow keys turn it, a number sets it");
        all.push_back ({ knobs.knob (i).getTitle(), about, focus, "knob " + std::to_string (i) });
        juce::PopupMenu menu;
        knobs.fillMenu (menu, i);
        addItems (menu, knobs.knob (i).getTitle() + ": ", all);
    }
    for (int n = 1; n <= snapshot_count; ++n)
    {
        juce::PopupMenu menu;
        parts.top.fillSnapshotMenu (menu, n, n);
        addItems (menu, {}, all);
    }
    for (auto& [name, choose] : parts.hand.choices())
        all.push_back ({ name, TRANS ("What moves the tool"), std::move (choose) });
}

void CommandSearch::addTabsAndButtons (std::vector<Action>& all)
{
    auto& layout = parts.layout;
    if (layout.isSmall())
        for (const auto& [name, part] : layout.pageParts())
            all.push_back ({ juce::translate (name), TRANS ("A page"), [this, shown = part] { parts.turnTo (*shown); } });
    for (auto* tabs : { &layout.bottom, &layout.left })
        for (int i = 0; const auto& [name, place] : tabs->titles())
            all.push_back ({ name, TRANS ("A panel"), [&layout, tabs, i = i++] { layout.reveal (*tabs->panel (i)); } });
    forButtons (parts.window, nullptr, [&] (juce::Button& b, juce::Component* panel) {
        const bool is_tab = panel != nullptr && dynamic_cast<Tabs*> (panel->getParentComponent()) != nullptr;
        const auto act = [this, name = nameOf (b), panel, is_tab] {
            if (is_tab) parts.layout.reveal (*panel);
            press (is_tab ? *panel : parts.window, name);
        };
        all.push_back ({ nameOf (b), b.getTooltip(), act });
    });
}

/// Adds the nodes of all patches that can be shown, those of the patch in view first, in the order of the list of nodes to add. A node is found by its name,
/// and as its type is found there.
void CommandSearch::addNodes (std::vector<Action>& all)
{
    if (parts.welcome.isVisible()) return;
    const auto& graph = parts.edited.graph();
    const auto types = paletteTypes (graph, parts.catalogue);
    std::vector<std::pair<std::pair<bool, std::size_t>, Action>> found;   // out of view, and the number of the type
    std::vector<std::string> patches { {} };
    for (std::size_t i = 0; i < patches.size(); ++i)
    {
        const auto in = patches[i];
        const auto* patch = findPatch (graph, in);
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
                auto& canvas = parts.patching;
                parts.turnTo (canvas);
                canvas.show (in, id);
                if (const auto* node = canvas.scene().find (id)) canvas.bringIntoView (node->bounds());
            };
            Action way { fromUtf8 (path), about, show, n.type + " (" + path + ')', std::move (searched) };
            found.emplace_back (std::pair { in != parts.patching.patch(), static_cast<std::size_t> (type - types.begin()) }, std::move (way));
        }
    }
    std::ranges::stable_sort (found, {}, [] (const auto& f) { return f.first; });
    for (auto& f : found)
        all.push_back (std::move (f.second));
}

/// Adds what can be added to the patch that the canvas shows.
void CommandSearch::addTypes (std::vector<Action>& all)
{
    auto& canvas = parts.patching;
    if (parts.welcome.isVisible()) return;
    for (auto& t : paletteTypes (parts.edited.graph(), parts.catalogue))
    {
        const auto add = [this, &canvas, type = t.entry.type] {
            parts.turnTo (canvas);
            addNode (parts.desk, type, { canvas.commands().pointerOrCentre() });
        };
        const auto name = filled (TRANS ("Add %1"), t.entry.name.empty() ? t.entry.type : t.entry.name);
        all.push_back ({ name, TRANS ("A node to add"), add, "add " + t.entry.type, { std::move (t.searched) }, true });
    }
}

void CommandSearch::open()
{
    std::vector<Action> all;
    addEdits (all);
    addChoices (all);
    addTabsAndButtons (all);
    addItems (menu.items(), {}, all);
    addNodes (all);
    for (const auto& p : parts.panels)
        if (p.panel.actions)
            for (auto& a : p.panel.actions())
                all.push_back ({ std::move (a.name), std::move (a.about), std::move (a.act) });
    addTypes (all);
    std::map<std::string, std::function<void()>> acts;
    std::vector<PaletteEntry> entries;
    std::vector<Findable> searched;
    std::vector<std::size_t> entry_of;   // by the number in `searched`
    std::set<std::size_t> last;          // entries
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
        if (a.comes_last) last.insert (entries.size());
        entries.push_back ({ key, name, about });
    }
    const auto search = [entries, searched, entry_of, last] (const std::string& query) {
        std::vector<PaletteEntry> found, found_last;
        std::set<std::size_t> seen;
        for (const auto i : bestMatches (searched, query))
            if (seen.insert (entry_of[i]).second) (last.contains (entry_of[i]) ? found_last : found).push_back (entries[entry_of[i]]);
        if (! juce::String (query).trim().isEmpty()) found.insert (found.end(), found_last.begin(), found_last.end());
        return found;
    };
    const auto choose = [this, acts] (const std::string& chosen) {
        takeFocus (keyboard.home());
        if (const auto found = acts.find (chosen); found != acts.end()) found->second();
    };
    const juce::Point<int> at { (parts.window.getWidth() - Palette::width) / 2, parts.top.getBottom() };
    parts.palette.open (at, search, TRANS ("Find a node of this graph, a command, a button or a panel"), choose, Palette::Finds::others);
}

}   // namespace tactus::host
