// SPDX-License-Identifier: GPL-3.0-or-later
#include "inspector.hpp"
#include "control_value.hpp"

#include <host/app/inspector/blocks/number_field.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoints.hpp>

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>

namespace tactus::host
{

Inspector::Inspector (Document& d, const Catalogue& c) : document (d), catalogue (c)
{
    setOpaque (true);
    setTitle (TRANS ("Inspector"));
    setFocusContainerType (FocusContainerType::keyboardFocusContainer);
    scroll.setScrollBarsShown (true, false);
    scroll.setScrollBarThickness (8);
    scroll.setWantsKeyboardFocus (false);   // the keys are for the fields
    setMouseClickGrabsKeyboardFocus (false);
    scroll.setMouseClickGrabsKeyboardFocus (false);
    addAndMakeVisible (scroll);
    addChildComponent (strip);
    strip.onHint = [this] (const juce::String& why) {
        if (onHint) onHint (why);
    };
    document.add (*this);
    rebuild();
}

Inspector::~Inspector() { document.remove (*this); }

void Inspector::inspect (SeenPatch p, std::set<graph::Id> s)
{
    // A node that is dragged is inspected at each step, and only its place has changed.
    const bool is_same = column && document.version() == version && p == patch && s == selection;
    version = document.version();
    patch = std::move (p);
    selection = std::move (s);
    if (! is_same) rebuild();
}

void Inspector::showLimits (const std::vector<ContactLimit>& now)
{
    if (now == contacts) return;
    contacts = now;
    rebuild();
}

void Inspector::refreshLive()
{
    if (column) column->refreshLive();
}

void Inspector::setHelp (bool on)
{
    help = on;
    rebuild();
}

InspectorContext Inspector::inspected()
{
    const auto refused = [this] (const juce::String& why) {
        if (onHint) onHint (why);
    };
    const auto folder = [this] { return document.graph().folder; };
    const auto messages = [this] { return messagesNow ? messagesNow() : Messages {}; };
    const auto contactsOf = [this] (const std::string& node) {
        std::vector<ContactLimit> its;
        std::ranges::copy_if (contacts, std::back_inserter (its), [&] (const ContactLimit& c) { return c.node == node || c.node.starts_with (node + '/'); });
        return its;
    };
    const auto menuOf = [this] (juce::PopupMenu& menu, const std::string& node, const std::string& port) { fillParamMenu (menu, node, port); };
    const auto choose = [this] (const juce::String& patterns, const std::filesystem::path& begin, auto chosen) {
        if (onChooseFile) onChooseFile (patterns, begin, std::move (chosen));
    };
    return { document, catalogue, patch.name, patch.path, refused, EditorContext { files, folder, refused, choose }, messages, contactsOf, menuOf,
             [this] (const std::string& param) { return valuesNow ? valuesNow (param) : std::vector<double> {}; } };
}

Inspector::SelectedItems Inspector::selected (const InspectorContext& at) const
{
    SelectedItems s;
    if (const auto* in = at.in())
    {
        for (const auto& n : in->nodes)
            if (selection.contains (n.id)) s.nodes.push_back (&n);
        std::set<std::string_view> names;
        for (const auto* n : s.nodes)
            names.insert (n->name);
        const auto isIn = [&names] (const graph::Endpoint& end) { return names.size() > 1 && names.contains (graph::firstNameOf (end.node)); };
        for (const auto& w : in->wires)
        {
            if (selection.contains (w.id)) s.wires.push_back (w.id);
            if (selection.contains (w.id) || (isIn (w.from) && isIn (w.to))) ++s.wire_count;
        }
    }
    s.key = patch.name + '|' + patch.path;
    for (const auto count : { s.nodes.size(), s.wires.size(), s.wire_count })
        s.key += '|' + std::to_string (count);
    if (help) s.key += '?';
    if (s.nodes.size() == 1) s.key += shapeOf (at, *s.nodes[0]);
    if (s.isOneWire()) s.key += std::to_string (s.wires[0]);
    if (! s.isEmpty()) return s;
    s.key += document.graph().name;
    for (const auto& c : document.graph().controls)
        s.key += '/' + c.id;
    return s;
}

std::unique_ptr<Column> Inspector::makeColumn (const InspectorContext& at, const SelectedItems& s)
{
    auto made = std::make_unique<Column>();
    const auto toggleHelp = [this] { setHelp (! help); };
    if (s.nodes.size() == 1)
        describeNode (at, *s.nodes[0], help, toggleHelp, *made);
    else if (s.isOneWire())
        describeWire (at, s.wires[0], *made);
    else if (s.isEmpty())
        describeGraph (at, *made);
    else
    {
        made->add (filled (TRANS ("%1 nodes, %2 wires"), s.nodes.size(), s.wire_count), TextBlock::Kind::title);
        made->add (TRANS ("Drag to move, B to bypass, G to group into a subgraph, Delete to delete."), TextBlock::Kind::small);
    }
    made->onHeight = [this] { resized(); };
    return made;
}

void Inspector::rebuild()
{
    const auto at = inspected();
    const auto now = selected (at);
    const auto* node = now.nodes.size() == 1 ? now.nodes[0] : nullptr;
    strip.refresh();
    strip.setVisible (! strip.isEmpty());
    if (now.key != made_for || ! column)
    {
        made_for = now.key;
        auto made = makeColumn (at, now);
        const auto of = std::make_pair (patch, selection);
        const auto place = column && of == shown_of ? scroll.getViewPosition() : juce::Point<int>();
        shown_of = of;
        if (column) letGoOfFocus (*column);
        retired = std::move (column);
        column = std::move (made);
        scroll.setViewedComponent (column.get(), false);
        column->refresh (node);
        resized();
        scroll.setViewPosition (place);
    }
    column->refresh (node);
    resized();
}

/// The fields point into the datasheets of node types.
void Inspector::typesChanged()
{
    made_for.clear();
    rebuild();
    retired.reset();
}

void Inspector::focusFirst()
{
    juce::Component* first = nullptr;
    for (auto* c : juce::KeyboardFocusTraverser().getAllComponents (this))
    {
        const bool is_field = dynamic_cast<NumberField*> (c) != nullptr || dynamic_cast<juce::ComboBox*> (c) != nullptr;
        if (first == nullptr || is_field) first = c;
        if (is_field) break;
    }
    if (first != nullptr) takeFocus (*first);
}

void Inspector::reveal (const juce::Component& field)
{
    const auto* inside = scroll.getViewedComponent();
    if (inside == nullptr || ! inside->isParentOf (&field)) return;
    const auto place = inside->getLocalArea (&field, field.getLocalBounds()).expanded (0, 8);
    const auto seen = scroll.getViewArea();
    if (place.getY() < seen.getY()) scroll.setViewPosition (0, place.getY());
    if (place.getBottom() > seen.getBottom()) scroll.setViewPosition (0, place.getBottom() - seen.getHeight());
}

void Inspector::paint (juce::Graphics& g)
{
    g.fillAll (themeOf (*this).panel);
    g.setColour (themeOf (*this).hairline);
    g.drawVerticalLine (0, 0.0f, static_cast<float> (getHeight()));
}

std::string Inspector::controlAt (juce::Point<int> screen)
{
    for (auto* at = getComponentAt (getLocalPoint (nullptr, screen)); at != nullptr && at != this; at = at->getParentComponent())
        if (const auto* id = at->getProperties().getVarPointer (shown_control)) return id->toString().toStdString();
    return {};
}

void Inspector::resized()
{
    auto area = getLocalBounds().withTrimmedLeft (1);
    const int most = area.getHeight() / 3;
    if (strip.isVisible()) strip.setBounds (area.removeFromBottom (std::min (most, strip.heightFor (area.getWidth()))));
    scroll.setBounds (area);
    if (column) column->layOut (scroll.getMaximumVisibleWidth());
}

}   // namespace tactus::host
