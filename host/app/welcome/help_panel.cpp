// SPDX-License-Identifier: GPL-3.0-or-later
#include "help_panel.hpp"

#include <host/app/canvas/commands.hpp>
#include <host/app/inspector/blocks/formula_block.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/key_text.hpp>
#include <host/app/model/node_doc.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/readable.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr int bar_height = 56;
constexpr auto subgraph_help = NEEDS_TRANS ("A subgraph: nodes and wires in a box. Double-click to enter it; the bar above the canvas leads back out.");
constexpr auto placeholder_help =
    NEEDS_TRANS ("This node type is not installed. The node is a placeholder that keeps its params and wires, and outputs 0. It works "
                 "again once the type is installed.");

juce::String text (std::string_view s) { return juce::String (std::string (s)); }

juce::String unitText (const UnitRule& u)
{
    switch (u.kind)
    {
    case UnitRule::Kind::fixed:
        return u.unit.symbol == "1" ? TRANS ("no unit") : fromUtf8 (unitShown (std::string (u.unit.symbol)));
    case UnitRule::Kind::open:
        return TRANS ("unit of the wired port");
    case UnitRule::Kind::each:
        return TRANS ("each entry has the unit of the port wired to it");
    case UnitRule::Kind::same:
        return filled (TRANS ("unit of %1"), u.a);
    case UnitRule::Kind::product:
        return u.b.empty() ? filled (TRANS ("product of the units of %1"), u.a) : filled (TRANS ("unit of %1 times %2"), u.a, u.b);
    }
    return {};
}

juce::String rangeText (const Interval& i, std::string_view symbol)
{
    if (std::isinf (i.min) && std::isinf (i.max)) return {};
    if (std::isinf (i.max)) return filled (TRANS ("at least %1"), shownQuantity (i.min, symbol));
    if (std::isinf (i.min)) return filled (TRANS ("at most %1"), shownQuantity (i.max, symbol));
    return filled (TRANS ("%1 to %2"), shownQuantity (i.min, symbol), shownQuantity (i.max, symbol));
}

juce::String about (const PortSheet& p)
{
    juce::StringArray parts;
    if (! p.choices.empty())
    {
        juce::StringArray names;
        for (const auto c : p.choices)
            names.add (text (c));
        parts.add (filled (TRANS ("one of %1"), names.joinIntoString (", ")));
    }
    else
    {
        parts.add ((p.width == 3 ? TRANS ("vector") + ", " : juce::String()) + unitText (p.unit));
        if (p.role == Role::param)
        {
            const auto symbol = p.unit.kind == UnitRule::Kind::fixed ? p.unit.unit.symbol : std::string_view {};
            auto initial = text (p.width == 3 ? numberText (p.initial[0]) : shownQuantity (p.initial[0], symbol));
            if (p.width == 3) initial << " " << text (numberText (p.initial[1])) << " " << text (numberText (p.initial[2]));
            parts.add (filled (TRANS ("default %1"), initial));
            if (const auto usual = rangeText (p.limits.usual, symbol); usual.isNotEmpty()) parts.add (filled (TRANS ("usually %1"), usual));
            if (const auto hard = rangeText (p.limits.hard, symbol); hard.isNotEmpty() && p.limits.hard != p.limits.usual)
                parts.add (filled (TRANS ("must be %1"), hard));
        }
    }
    if (p.limits.latch) parts.add (TRANS ("read at the start of contact"));
    parts.removeEmptyStrings();
    return parts.joinIntoString ("; ");
}

/// The width of the column of names, which the lines of a help text share. Each line widens the column for its own name.
struct NameColumn
{
    float widest = 0.0f;

    int in (int whole) const { return std::min (static_cast<int> (std::ceil (widest)) + 20, whole * 2 / 5); }
};

/// A line about a port or a key: its name at the left, and beside it its unit and description.
class PortLine final : public Block
{
public:
    PortLine (std::shared_ptr<NameColumn> c, juce::String n, juce::String d, juce::String s)
        : names (std::move (c)), name (std::move (n)), details (std::move (d)), sentence (std::move (s))
    {
        setInterceptsMouseClicks (false, false);
        names->widest = std::max (names->widest, lookOf (*this).font (13.0f, true).getStringWidthFloat (name));
    }

    int heightFor (int w) override { return static_cast<int> (std::ceil (std::max (nameIn (w).getHeight(), textIn (w).getHeight()))) + 8; }

    void paint (juce::Graphics& g) override
    {
        const auto area = getLocalBounds().toFloat();
        nameIn (getWidth()).draw (g, area);
        textIn (getWidth()).draw (g, area.withTrimmedLeft (static_cast<float> (names->in (getWidth()))));
    }

private:
    juce::TextLayout nameIn (int w) const
    {
        const auto& look = lookOf (*this);
        return wrapText (name, look.font (13.0f, true), look.theme().text, static_cast<float> (names->in (w)-12));
    }

    juce::TextLayout textIn (int w) const
    {
        const auto& look = lookOf (*this);
        juce::AttributedString s;
        if (details.isNotEmpty()) s.append (details, look.font (12.0f), look.theme().dim);
        if (sentence.isNotEmpty()) s.append ((details.isEmpty() ? "" : "\n") + sentence, look.font (13.0f), look.theme().text);
        juce::TextLayout l;
        l.createLayout (s, static_cast<float> (w - names->in (w)));
        return l;
    }

    std::shared_ptr<NameColumn> names;
    juce::String name, details, sentence;
};

void addPorts (Column& column, const std::shared_ptr<NameColumn>& names, const juce::String& heading, const std::vector<PortSheet>& ports)
{
    if (ports.empty()) return;
    column.add (heading, TextBlock::Kind::heading);
    for (const auto& p : ports)
        column.add (std::make_unique<PortLine> (names, text (nameWithId (p.id)) + (p.list ? "[0], [1] ..." : ""), about (p), text (p.about)));
}

using Keys = std::pair<const char*, const char*>;
constexpr std::array key_list {
    Keys { NEEDS_TRANS ("Esc"),
           NEEDS_TRANS ("closes what is open, such as a field or the help; if nothing is, over a menu or the palette, or if a real device runs, "
                        "ramps all forces to zero first") },
    Keys { NEEDS_TRANS ("Shift+Esc"), NEEDS_TRANS ("emergency stop: no forces until REARM or START, while the graph keeps running") },
    Keys { NEEDS_TRANS ("F5"), NEEDS_TRANS ("starts the graph") },
    Keys { NEEDS_TRANS ("F6, Shift+F6"), NEEDS_TRANS ("goes to the next or the previous panel") },
    Keys { NEEDS_TRANS ("Ctrl+K, F3"),
           NEEDS_TRANS ("finds a node of the graph and shows it, or a command, a button or a panel and does what a click on it does") },
    Keys { NEEDS_TRANS ("1 ... 9"), NEEDS_TRANS ("recalls a snapshot; with Ctrl, stores it") },
    Keys { NEEDS_TRANS ("V"), NEEDS_TRANS ("switches between the last two snapshots") },
    Keys { NEEDS_TRANS ("Ctrl+N, Ctrl+O, Ctrl+S, Ctrl+Shift+S, Ctrl+Q"), NEEDS_TRANS ("new, open, save, save as, quit") },
    Keys { NEEDS_TRANS ("Z"), NEEDS_TRANS ("gives the window to the canvas, or brings the panels back") },
    Keys { NEEDS_TRANS ("H"), NEEDS_TRANS ("holds the tool pressed where it is, or releases it") },
    Keys { NEEDS_TRANS ("S, held"),
           NEEDS_TRANS ("moves the workspace of the device with the hand, as one lifts a mouse, while the canvas or the scene has the keyboard. The force "
                        "fades, and comes back after the release") },
    Keys { NEEDS_TRANS ("C"), NEEDS_TRANS ("shows the CPU cost of each node") },
    Keys { NEEDS_TRANS ("Shift+F1"), NEEDS_TRANS ("guided tour of the window") },
    Keys { NEEDS_TRANS ("F1 or ?"), NEEDS_TRANS ("help on the selected node, or this list") },
    Keys { NEEDS_TRANS ("Ctrl+Left, Ctrl+Right"), NEEDS_TRANS ("in the mixer, go to the same field or button of the layer beside") },
    Keys { NEEDS_TRANS ("Page Up, Page Down, Home, End"), NEEDS_TRANS ("scroll this help") },
};
constexpr std::array mouse_list {
    Keys { NEEDS_TRANS ("drag on a number"), NEEDS_TRANS ("changes it, with Shift in fine steps; double-click to type a value with its unit") },
    Keys { NEEDS_TRANS ("drag from a port"), NEEDS_TRANS ("draws a wire: matching ports light up; drop it on the canvas to add a matching node") },
    Keys { NEEDS_TRANS ("double-click on the canvas"), NEEDS_TRANS ("adds a node there") },
    Keys { NEEDS_TRANS ("middle or right button, wheel"), NEEDS_TRANS ("the buttons pan, the wheel zooms at the pointer; a right click opens the menu") },
    Keys { NEEDS_TRANS ("drag an arrow in the 3D scene"), NEEDS_TRANS ("moves the box that a device can reach; the force fades while it moves") },
    Keys { NEEDS_TRANS ("press on the surface below"), NEEDS_TRANS ("moves the tool with the mouse as your hand; the arrow is the force on it") },
};

/// Adds the documentation from a node header, with its layout.
void addDoc (Column& column, std::span<const DocPart> parts)
{
    std::vector<std::string> formulas;   // lines that follow each other, because they share their columns
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
        const auto& p = parts[i];
        switch (p.kind)
        {
        case DocPart::Kind::formula:
            formulas.push_back (p.text);
            if (i + 1 < parts.size() && parts[i + 1].kind == DocPart::Kind::formula) break;
            column.add (std::make_unique<FormulaBlock> (std::exchange (formulas, {})));
            break;
        case DocPart::Kind::text:
            column.add (FormulaBlock::paragraph (p.text));
            break;
        case DocPart::Kind::heading:
            column.add (text (p.text), TextBlock::Kind::heading);
            break;
        case DocPart::Kind::item:
            column.add (FormulaBlock::paragraph ("– " + p.text));
            break;
        }
    }
}
}   // namespace

HelpPanel::HelpPanel (const Catalogue& c) : catalogue (c)
{
    setTitle (TRANS ("Help"));
    setVisible (false);
    scroll.setTitle (TRANS ("Help text"));
    scroll.setScrollBarsShown (true, false);
    scroll.setScrollBarThickness (8);
    addAndMakeVisible (scroll);
    example.setFirst (true);
    example.onClick = [this] {
        const auto of = shown_type;
        close();
        if (onExample) onExample (of);
    };
    keys.onClick = [this] { showKeys(); };
    done.onClick = [this] { close(); };
    for (auto* b : { &example, &keys, &done })
        addAndMakeVisible (b);
}

void HelpPanel::showNode (const std::string& type)
{
    const auto* node = catalogue.find (type);
    auto made = std::make_unique<Column>();
    if (node == nullptr)
    {
        const bool is_subgraph = type.starts_with ("graph:") || type.starts_with ("file:");
        made->add (juce::String (type), TextBlock::Kind::title);
        made->add (juce::translate (is_subgraph ? subgraph_help : placeholder_help), TextBlock::Kind::text);
    }
    else
    {
        made->add (text (node->info.name), TextBlock::Kind::title);
        made->add (text (node->info.id), TextBlock::Kind::small);
        made->add (text (node->info.summary), TextBlock::Kind::text);
        const auto doc = docOf (node->info.id);
        const auto source = std::ranges::find_if (doc, [] (const DocPart& p) { return p.text.starts_with ("Source:"); });
        addDoc (*made, { doc.begin(), source });
        const auto names = std::make_shared<NameColumn>();
        addPorts (*made, names, TRANS ("Inputs"), node->inputs);
        addPorts (*made, names, TRANS ("Parameters"), node->params);
        if (! node->settings.empty())
        {
            made->add (TRANS ("Settings, fixed during a run"), TextBlock::Kind::heading);
            for (const auto& s : node->settings)
                made->add (std::make_unique<PortLine> (names, text (nameWithId (s.id)), text (tactus::name (s.kind)), text (s.about)));
        }
        addPorts (*made, names, TRANS ("Outputs"), node->outputs);
        addDoc (*made, { source, doc.end() });
    }
    shown_type = type;
    example.setVisible (node != nullptr);
    keys.setVisible (true);
    show (std::move (made));
}

void HelpPanel::showKeys()
{
    auto made = std::make_unique<Column>();
    made->add (TRANS ("Keyboard shortcuts"), TextBlock::Kind::title);
    const auto names = std::make_shared<NameColumn>();
    const auto add = [&] (const juce::String& key, const char* does) {
        made->add (std::make_unique<PortLine> (names, key, juce::String(), juce::translate (does)));
    };
    const auto first_own = std::begin (key_list) + 4;   // after those that every part of the window obeys
    for (auto k = std::begin (key_list); k != std::end (key_list); ++k)
    {
        if (k == first_own)
            for (const auto& [key, does] : panel_keys)
                add (juce::translate (key), does);
        add (juce::translate (k->first), k->second);
    }
    made->add (TRANS ("On the canvas"), TextBlock::Kind::heading);
    for (const auto& c : canvasCommands())
    {
        juce::StringArray of_command;
        for (const auto& k : juce::StringArray::fromTokens (c.keys, "|", {}))
            of_command.add (keyText (k));
        if (of_command.isEmpty()) of_command.add (TRANS ("menu"));
        add (of_command.joinIntoString (", "), c.name);
    }
    made->add (TRANS ("Mouse"), TextBlock::Kind::heading);
    for (const auto& [way, does] : mouse_list)
        add (juce::translate (way), does);
    made->add (TRANS ("Select a node and press F1 to read what it does."), TextBlock::Kind::small);
    shown_type.clear();
    example.setVisible (false);
    keys.setVisible (false);
    show (std::move (made));
}

void HelpPanel::show (std::unique_ptr<Column> made)
{
    column = std::move (made);
    scroll.setViewedComponent (column.get(), false);
    scroll.setViewPosition (0, 0);
    setVisible (true);
    toFront (false);
    place();
    repaint();
}

void HelpPanel::setArea (juce::Rectangle<int> a)
{
    area = a;
    place();
}

void HelpPanel::place()
{
    const int w = std::min (width, area.getWidth());
    if (column) column->layOut (w - 2 - scroll.getScrollBarThickness());
    const int h = std::min (area.getHeight(), (column ? column->getHeight() : 0) + bar_height + 2);
    setBounds (area.withSizeKeepingCentre (w, h).withY (area.getY()));
    resized();
}

void HelpPanel::close()
{
    if (! isOpen()) return;
    setVisible (false);
    if (auto* parent = getParentComponent()) takeFocus (*parent);
}

void HelpPanel::resized()
{
    auto inside = getLocalBounds().reduced (1);
    auto bar = inside.removeFromBottom (bar_height).reduced (16, 12);
    done.setBounds (bar.removeFromRight (done.widthFor()));
    bar.removeFromRight (8);
    keys.setBounds (bar.removeFromRight (keys.widthFor()));
    example.setBounds (bar.removeFromLeft (example.widthFor()));
    scroll.setBounds (inside);
    if (column) column->layOut (scroll.getMaximumVisibleWidth());
}

void HelpPanel::paint (juce::Graphics& g)
{
    const auto& theme = themeOf (*this);
    g.setColour (theme.panel);
    g.fillRoundedRectangle (getLocalBounds().toFloat(), 8.0f);
    g.setColour (theme.hairline);
    g.drawRoundedRectangle (getLocalBounds().toFloat().reduced (0.5f), 8.0f, 1.0f);
    g.drawHorizontalLine (getHeight() - bar_height - 1, 1.0f, static_cast<float> (getWidth()) - 1.0f);
}

}   // namespace tactus::host
