// SPDX-License-Identifier: GPL-3.0-or-later
#include "scope_view.hpp"

#include "energy_plot.hpp"
#include "over_plot.hpp"
#include "spectrum_plot.hpp"
#include "time_plot.hpp"
#include "tool_plot.hpp"
#include "trace_file.hpp"

#include <host/io/atomic_file.hpp>

namespace tactus::host
{

namespace
{
juce::Path lines (std::initializer_list<juce::Line<float>> all)
{
    juce::Path p;
    for (const auto& l : all)
    {
        p.startNewSubPath (l.getStart());
        p.lineTo (l.getEnd());
    }
    return p;
}

juce::Path cross() { return lines ({ { 3, 3, 11, 11 }, { 11, 3, 3, 11 } }); }
juce::Path twoBars() { return lines ({ { 5, 3, 5, 11 }, { 9, 3, 9, 11 } }); }
juce::Path downArrow() { return lines ({ { 7, 1, 7, 9 }, { 3.5f, 5.5f, 7, 9 }, { 10.5f, 5.5f, 7, 9 }, { 2, 12.5f, 12, 12.5f } }); }
}   // namespace

juce::String titleOf (ScopeKind k)
{
    switch (k)
    {
    case ScopeKind::time:
        return "Time";
    case ScopeKind::over:
        return "Force over displacement";
    case ScopeKind::spectrum:
        return "Spectrum";
    case ScopeKind::energy:
        return "Energy";
    case ScopeKind::tool:
        break;
    }
    return "At the tool";
}

std::unique_ptr<ScopePlot> makePlot (ScopeSpec& s, ScopeDesk& d)
{
    switch (s.kind)
    {
    case ScopeKind::time:
        return std::make_unique<TimePlot> (s, d);
    case ScopeKind::over:
        return std::make_unique<OverPlot> (s, d);
    case ScopeKind::spectrum:
        return std::make_unique<SpectrumPlot> (s, d);
    case ScopeKind::energy:
        return std::make_unique<EnergyPlot> (s, d);
    case ScopeKind::tool:
        break;
    }
    return std::make_unique<ToolPlot> (s, d);
}

ScopeView::ScopeView (ScopeSpec& s, ScopeDesk& d, Signals from) : spec (s), desk (d), live (std::move (from)), drawing (makePlot (s, d))
{
    setTitle (titleOf (s.kind));
    freeze_button = std::make_unique<FlatButton> ("Freeze this scope", twoBars());
    save_button = std::make_unique<FlatButton> ("Save as a picture or as numbers", downArrow());
    close_button = std::make_unique<FlatButton> ("Close this scope", cross());
    freeze_button->onClick = [this]
    {
        freeze (! isFrozen());
        if (onFreeze) onFreeze();
    };
    save_button->onClick = [this]
    {
        if (onSave) onSave (*save_button);
    };
    close_button->onClick = [this]
    {
        if (onClose) onClose();
    };
    for (auto* b : { freeze_button.get(), save_button.get(), close_button.get() })
    {
        b->setTooltip (b->getName());
        addAndMakeVisible (*b);
    }
    addAndMakeVisible (*drawing);
}

TraceList ScopeView::of (const std::string& port) const
{
    if (! spec.is_frozen) return live (port);
    const auto found = held.find (port);
    return found == held.end() ? TraceList {} : found->second;
}

void ScopeView::freeze (bool on)
{
    if (on == spec.is_frozen) return;
    held.clear();
    if (on)
        for (const auto& port : portsOf (spec, desk.energies))
            for (const auto& t : live (port))
                held[port].push_back (std::make_shared<const Trace> (*t));
    spec.is_frozen = on;
    freeze_button->setToggleState (on, juce::dontSendNotification);
    refresh();
}

void ScopeView::redraw()
{
    drawing->show ([this] (const std::string& port)
                   { return of (port); });
}

void ScopeView::refresh()
{
    redraw();
    if (const auto key = headerKey(); key != header_of)
    {
        rebuildHeader();
        header_of = key;
    }
}

/// All that the header says, so that it is made anew only when that is another.
std::string ScopeView::headerKey()
{
    std::string key = std::to_string (static_cast<int> (spec.kind)) + std::to_string (reinterpret_cast<std::uintptr_t> (&themeOf (*this)));
    for (const auto& a : drawing->actions())
        key += '|' + a.text.toStdString();
    for (const auto& p : portsOf (spec, spec.kind == ScopeKind::energy ? std::vector<std::string> {} : desk.energies))
        key += '|' + p + (isThere (p, desk.ports) ? "" : "!") + std::to_string (of (p).size());
    return key + '|' + std::to_string (getWidth());
}

void ScopeView::addChip (const juce::String& text, const std::string& port, juce::Colour dot, std::function<void()> onClick, const juce::String& about, bool is_removable)
{
    const bool is_gone = ! port.empty() && ! isThere (port, desk.ports);
    auto& chip = *chips.emplace_back (std::make_unique<FlatButton> (is_gone ? juce::String (port) + " is gone" : text));
    chip.dot = dot;
    chip.is_amiss = is_gone;
    chip.setTooltip (about);
    // The chip may go by what it does; it does it once it has been let go.
    (is_removable ? chip.onCross : chip.onClick) = [safe = juce::Component::SafePointer (this), onClick = std::move (onClick)]
    { juce::MessageManager::callAsync ([safe, onClick]
                                       {
        if (safe != nullptr) onClick(); }); };
    addAndMakeVisible (chip);
}

void ScopeView::rebuildHeader()
{
    const auto& theme = themeOf (*this);
    links.clear();
    chips.clear();
    for (auto& a : drawing->actions())
    {
        auto& b = *links.emplace_back (std::make_unique<FlatButton> (a.text));
        b.setTooltip (a.about);
        b.onClick = [&b, click = a.onClick]
        { click (b); };
        addAndMakeVisible (b);
    }
    const auto changed = [this]
    {
        if (desk.onChange) desk.onChange();
    };
    const auto choose = [this, changed] (std::string ScopeSpec::*end)
    {
        choosePort (*drawing, desk.ports, [safe = juce::Component::SafePointer (this), end, changed] (const std::string& port)
                    {
            if (safe == nullptr) return;
            auto& s = safe->spec;
            s.*end = port;
            if (end == &ScopeSpec::y) s.state = stateFor (port, safe->desk.ports);
            s.by_hand.clear();
            changed(); });
    };
    if (spec.kind == ScopeKind::time || spec.kind == ScopeKind::spectrum)
    {
        std::map<std::string, std::size_t> ports_of_unit;
        for (const auto& port : spec.ports)
        {
            const auto traces = of (port);
            const auto nth = traces.empty() ? 0 : ports_of_unit[traces.front()->unit()]++;
            const auto dot = traces.empty() ? theme.dim : traceColour (theme, traces.front()->quantity(), nth, 0);
            addChip (
                juce::String (port), port, dot, [this, port, changed]
                {
                std::erase (spec.ports, port);
                changed(); },
                "The cross takes it out of this scope", true);
        }
        addChip (
            "+", {}, {}, [this, changed]
            { choosePort (*drawing, desk.ports, [safe = juce::Component::SafePointer (this), changed] (const std::string& port)
                          {
            if (safe == nullptr || std::ranges::count (safe->spec.ports, port) > 0) return;
            safe->spec.ports.push_back (port);
            changed(); }); },
            "Shows another port here");
    }
    if (spec.kind == ScopeKind::over)
    {
        addChip (
            spec.y.empty() ? juce::String ("up: choose") : juce::String (spec.y), spec.y, theme.of (Quantity::force), [choose]
            { choose (&ScopeSpec::y); },
            "What stands up; click to choose another");
        addChip (
            spec.x.empty() ? juce::String ("across: choose") : "over " + juce::String (spec.x), spec.x, theme.of (Quantity::length), [choose]
            { choose (&ScopeSpec::x); },
            "What stands across; click to choose another");
    }
    if (spec.kind == ScopeKind::energy && ! spec.x.empty())
    {
        addChip (
            spec.y, spec.y, theme.of (Quantity::force), [choose]
            { choose (&ScopeSpec::y); },
            "The force on the tool, which with its way gives the work of the hand; click to choose another");
        addChip (
            juce::String (spec.x), spec.x, theme.of (Quantity::length), [choose]
            { choose (&ScopeSpec::x); },
            "Where the tool is; click to choose another");
    }
    if (spec.kind == ScopeKind::tool && ! spec.node.empty())
    {
        const auto port = spec.node + ".deflection";
        addChip (
            isThere (port, desk.ports) ? juce::String (spec.node) : juce::String(), port, theme.of (Quantity::force), [this, changed]
            {
            juce::PopupMenu menu;
            for (const auto& p : desk.ports)
                if (p.port.role == Role::output && p.port.id == "deflection" && p.type.starts_with ("friction."))
                    menu.addItem (juce::String (p.path), [safe = juce::Component::SafePointer (this), path = p.path, changed]
                                  {
                if (safe == nullptr) return;
                safe->spec.node = path;
                changed(); });
            menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (*drawing)); },
            "Which friction node; click to choose another");
    }
    resized();
    repaint();
}

void ScopeView::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.fillAll (look.theme().panel);
    const auto font = look.font (12.0f, true);
    g.setFont (font);
    g.setColour (look.theme().text);
    g.drawText (titleOf (spec.kind), getLocalBounds().removeFromTop (header_height).withTrimmedLeft (8).withTrimmedRight (80), juce::Justification::centredLeft, true);
}

void ScopeView::resized()
{
    auto area = getLocalBounds();
    auto header = area.removeFromTop (header_height).reduced (0, 1);
    header.removeFromRight (4);
    for (auto* b : { close_button.get(), save_button.get(), freeze_button.get() })
        b->setBounds (header.removeFromRight (FlatButton::height));
    header.removeFromLeft (static_cast<int> (lookOf (*this).font (12.0f, true).getStringWidthFloat (titleOf (spec.kind))) + 14);
    for (auto& l : links)
    {
        const int width = l->wantedWidth();
        l->setBounds (header.removeFromLeft (width));
        l->setVisible (l->getWidth() == width);   // no half of a word
    }
    auto row = area.removeFromTop (chips_height).withTrimmedLeft (2).reduced (0, 1);
    for (auto& c : chips)
    {
        c->setBounds (row.removeFromLeft (std::min (c->wantedWidth(), row.getWidth())));
        c->setVisible (c->getWidth() >= FlatButton::height - 6);
    }
    drawing->setBounds (area.reduced (1, 0));
}

tl::expected<void, Error> ScopeView::savePicture (const std::filesystem::path& path)
{
    const auto image = createComponentSnapshot (getLocalBounds(), true, 2.0f);
    juce::MemoryOutputStream bytes;
    if (! juce::PNGImageFormat().writeImageToStream (image, bytes)) return tl::unexpected (Error { "scope/picture", path.string(), "the picture could not be made", "make the scope larger" });
    auto file = createFile (path);
    if (! file) return tl::unexpected (file.error());
    if (! file->stream().write (static_cast<const char*> (bytes.getData()), static_cast<std::streamsize> (bytes.getDataSize()))) return tl::unexpected (writeFailed (*file));
    return commitFile (*file);
}

tl::expected<void, Error> ScopeView::saveNumbers (const std::filesystem::path& path)
{
    TraceList all;
    for (const auto& port : portsOf (spec, desk.energies))
        for (const auto& t : of (port))
            all.push_back (t);
    for (const auto& t : drawing->made())
        all.push_back (t);
    return writeTraces (path, all);
}

}   // namespace tactus::host
