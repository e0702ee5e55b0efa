// SPDX-License-Identifier: GPL-3.0-or-later
#include "help_panel.hpp"

#include <host/app/canvas/commands.hpp>
#include <host/app/inspector/formula_block.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/key_text.hpp>
#include <host/app/look/text.hpp>
#include <host/app/model/node_doc.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/readable.hpp>

#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr int bar_height = 56;
constexpr auto subgraph_help = "A subgraph: nodes and wires in a box. Double-click to enter it; the bar above the canvas leads back out.";
constexpr auto placeholder_help = "This node type is not installed. The node is a placeholder that keeps its params and wires, and outputs 0. It works "
                                  "again once the type is installed.";

juce::String text (std::string_view s) { return juce::String (std::string (s)); }

juce::String unitText (const UnitRule& u)
{
    switch (u.kind)
    {
    case UnitRule::Kind::fixed:
        return u.unit.symbol == "1" ? juce::String ("no unit") : fromUtf8 (unitShown (std::string (u.unit.symbol)));
    case UnitRule::Kind::open:
        return "unit of the wired port";
    case UnitRule::Kind::each:
        return "each entry has the unit of the port wired to it";
    case UnitRule::Kind::same:
        return "unit of " + text (u.a);
    case UnitRule::Kind::product:
        return u.b.empty() ? "product of the units of " + text (u.a) : "unit of " + text (u.a) + " times " + text (u.b);
    }
    return {};
}

juce::String rangeText (const Interval& i, std::string_view symbol)
{
    if (std::isinf (i.min) && std::isinf (i.max)) return {};
    if (std::isinf (i.max)) return "at least " + text (shownQuantity (i.min, symbol));
    if (std::isinf (i.min)) return "at most " + text (shownQuantity (i.max, symbol));
    return text (shownQuantity (i.min, symbol)) + " to " + text (shownQuantity (i.max, symbol));
}

juce::String about (const PortSheet& p)
{
    juce::StringArray parts;
    if (! p.choices.empty())
    {
        juce::StringArray names;
        for (const auto c : p.choices)
            names.add (text (c));
        parts.add ("one of " + names.joinIntoString (", "));
    }
    else
    {
        parts.add ((p.width == 3 ? "vector, " : "") + unitText (p.unit));
        if (p.role == Role::param)
        {
            const auto symbol = p.unit.kind == UnitRule::Kind::fixed ? p.unit.unit.symbol : std::string_view {};
            auto initial = "default " + text (p.width == 3 ? numberText (p.initial[0]) : shownQuantity (p.initial[0], symbol));
            if (p.width == 3) initial << " " << text (numberText (p.initial[1])) << " " << text (numberText (p.initial[2]));
            parts.add (initial);
            if (const auto usual = rangeText (p.limits.usual, symbol); usual.isNotEmpty()) parts.add ("usually " + usual);
            if (const auto hard = rangeText (p.limits.hard, symbol); hard.isNotEmpty() && p.limits.hard != p.limits.usual) parts.add ("must be " + hard);
        }
    }
    if (p.limits.latch) parts.add ("read at the start of contact");
    parts.removeEmptyStrings();
    return parts.joinIntoString ("; ");
}

/// A line about a port: its name, unit and description.
class PortLine final : public Block
{
public:
    PortLine (juce::String n, juce::String d, juce::String s) : name (std::move (n)), details (std::move (d)), sentence (std::move (s))
    {
        setInterceptsMouseClicks (false, false);
    }

    int heightFor (int w) override { return static_cast<int> (std::ceil (layout (w).getHeight())) + 8; }
    void paint (juce::Graphics& g) override { layout (getWidth()).draw (g, getLocalBounds().toFloat()); }

private:
    juce::TextLayout layout (int w) const
    {
        const auto& look = lookOf (*this);
        juce::AttributedString s;
        s.append (name, look.font (13.0f, true), look.theme().text);
        if (details.isNotEmpty()) s.append ("   " + details, look.font (12.0f), look.theme().dim);
        if (sentence.isNotEmpty()) s.append ("\n" + sentence, look.font (13.0f), look.theme().text);
        juce::TextLayout l;
        l.createLayout (s, static_cast<float> (w));
        return l;
    }

    juce::String name, details, sentence;
};

void addPorts (Column& column, const char* heading, const std::vector<PortSheet>& ports)
{
    if (ports.empty()) return;
    column.add (heading, TextBlock::Kind::heading);
    for (const auto& p : ports)
        column.add (std::make_unique<PortLine> (text (nameWithId (p.id)) + (p.list ? "[0], [1] ..." : ""), about (p), text (p.about)));
}

using Keys = std::pair<const char*, const char*>;
constexpr std::array key_list {
    Keys { "Esc", "closes what is open, such as a menu or a field; if nothing is, or a real device runs, ramps all forces to zero" },
    Keys { "Shift+Esc", "emergency stop: no forces until REARM, while the graph keeps running" },
    Keys { "1 ... 9", "recalls a snapshot; with Ctrl, stores it" },
    Keys { "Ctrl+N, Ctrl+O, Ctrl+S, Ctrl+Shift+S", "new, open, save, save as" },
    Keys { "Z", "gives the window to the canvas, or brings the panels back" },
    Keys { "H", "holds the tool pressed where it is, or releases it" },
    Keys { "X", "freezes or unfreezes all scopes" },
    Keys { "C", "shows the CPU cost of each node" },
    Keys { "F1 or ?", "help on the selected node, or this list" },
};
constexpr std::array mouse_list {
    Keys { "drag on a number", "changes it, with Shift in fine steps; double-click to type a value with its unit" },
    Keys { "drag from a port", "draws a wire: matching ports light up; drop it on the canvas to add a matching node" },
    Keys { "double-click on the canvas", "adds a node there" },
    Keys { "middle or right button, wheel", "the buttons pan, the wheel zooms at the pointer; a right click opens the menu" },
    Keys { "press on the surface below", "moves the tool with the mouse as your hand; the arrow is the force on it" },
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
    setTitle ("Help");
    setVisible (false);
    scroll.setTitle ("Help text");
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
        made->add (is_subgraph ? subgraph_help : placeholder_help, TextBlock::Kind::text);
    }
    else
    {
        made->add (text (node->info.name), TextBlock::Kind::title);
        made->add (text (node->info.id), TextBlock::Kind::small);
        made->add (text (node->info.summary), TextBlock::Kind::text);
        const auto doc = docOf (node->info.id);
        const auto source = std::ranges::find_if (doc, [] (const DocPart& p) { return p.text.starts_with ("Source:"); });
        addDoc (*made, { doc.begin(), source });
        addPorts (*made, "Inputs", node->inputs);
        addPorts (*made, "Parameters", node->params);
        if (! node->settings.empty())
        {
            made->add ("Settings, fixed during a run", TextBlock::Kind::heading);
            for (const auto& s : node->settings)
                made->add (std::make_unique<PortLine> (text (nameWithId (s.id)), text (tactus::name (s.kind)), text (s.about)));
        }
        addPorts (*made, "Outputs", node->outputs);
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
    made->add ("Keyboard shortcuts", TextBlock::Kind::title);
    for (const auto& [key, does] : key_list)
        made->add (std::make_unique<PortLine> (key, does, juce::String()));
    made->add ("On the canvas", TextBlock::Kind::heading);
    for (const auto& c : canvasCommands())
    {
        juce::StringArray names;
        for (const auto& k : juce::StringArray::fromTokens (c.keys, "|", {}))
            names.add (keyText (k));
        if (names.isEmpty()) names.add ("menu");
        made->add (std::make_unique<PortLine> (names.joinIntoString (", "), juce::String (c.name), juce::String()));
    }
    made->add ("Mouse", TextBlock::Kind::heading);
    for (const auto& [way, does] : mouse_list)
        made->add (std::make_unique<PortLine> (way, does, juce::String()));
    made->add ("Select a node and press F1 to read what it does.", TextBlock::Kind::small);
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
