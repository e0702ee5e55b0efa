// SPDX-License-Identifier: GPL-3.0-or-later
#include "scope_view.hpp"

#include "energy_plot.hpp"
#include "over_plot.hpp"
#include "spectrogram_plot.hpp"
#include "spectrum_plot.hpp"
#include "time_plot.hpp"
#include "tool_plot.hpp"
#include "trace_file.hpp"

#include <host/app/text/filled.hpp>

#include <tactus/file/atomic_file.hpp>

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
        return TRANS ("Time");
    case ScopeKind::over:
        return TRANS ("Force against displacement");
    case ScopeKind::spectrum:
        return TRANS ("Spectrum");
    case ScopeKind::spectrogram:
        return TRANS ("Spectrogram");
    case ScopeKind::energy:
        return TRANS ("Energy");
    case ScopeKind::tool:
        break;
    }
    return TRANS ("Tool view");
}

std::unique_ptr<ScopePlot> makePlot (ScopeSpec& s, ScopeContext& d)
{
    switch (s.kind)
    {
    case ScopeKind::time:
        return std::make_unique<TimePlot> (s, d);
    case ScopeKind::over:
        return std::make_unique<OverPlot> (s, d);
    case ScopeKind::spectrum:
        return std::make_unique<SpectrumPlot> (s, d);
    case ScopeKind::spectrogram:
        return std::make_unique<SpectrogramPlot> (s, d);
    case ScopeKind::energy:
        return std::make_unique<EnergyPlot> (s, d);
    case ScopeKind::tool:
        break;
    }
    return std::make_unique<ToolPlot> (s, d);
}

ScopeView::ScopeView (ScopeSpec& s, ScopeContext& c, Signals from) : spec (s), context (c), live (std::move (from)), drawing (makePlot (s, c))
{
    setOpaque (true);
    setTitle (titleOf (s.kind));
    setMouseCursor (juce::MouseCursor::DraggingHandCursor);   // of its title, which can be dragged to another place
    freeze_button = std::make_unique<FlatButton> (TRANS ("Freeze this scope"), twoBars());
    save_button = std::make_unique<FlatButton> (TRANS ("Save as image or data"), downArrow());
    close_button = std::make_unique<FlatButton> (TRANS ("Close this scope"), cross());
    freeze_button->onClick = [this] {
        freeze (! isFrozen());
        if (onFreeze) onFreeze();
    };
    save_button->onClick = [this] {
        if (onSave) onSave (*save_button);
    };
    close_button->onClick = [this] {
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
        for (const auto& port : portsOf (spec, context.energies))
            for (const auto& t : live (port))
                held[port].push_back (std::make_shared<const Trace> (*t));
    spec.is_frozen = on;
    freeze_button->setToggleState (on, juce::dontSendNotification);
    refresh();
}

void ScopeView::redraw()
{
    ++times_drawn;
    still_for = 0;
    drawing->show ([this] (const std::string& port) { return of (port); });
}

/// True if nothing has changed for so long that the ranges of the axes have settled, too.
bool ScopeView::isAtRest()
{
    constexpr int settles = AutoRange::usual_patience + 15;
    Seen now { spec, context.edits, spec.is_frozen ? 0 : context.samples, &themeOf (*this), getBounds() };
    if (seen == now) return ++still_for > settles;
    seen = std::move (now);
    still_for = 0;
    return false;
}

void ScopeView::refresh()
{
    if (isAtRest()) return;
    const int still = still_for;
    redraw();
    still_for = still;
    if (const auto key = headerKey(); key != header_of)
    {
        rebuildHeader();
        header_of = key;
    }
}

/// Everything the header depends on, so that it is rebuilt only if something has changed.
std::string ScopeView::headerKey()
{
    std::string key = std::to_string (static_cast<int> (spec.kind)) + std::to_string (reinterpret_cast<std::uintptr_t> (&themeOf (*this)));
    for (const auto& a : drawing->actions())
        key += '|' + a.text.toStdString();
    for (const auto& p : portsOf (spec, spec.kind == ScopeKind::energy ? std::vector<std::string> {} : context.energies))
        key += '|' + p + (context.names.has (p) ? "" : "!") + std::to_string (of (p).size());
    return key + '|' + std::to_string (getWidth());
}

void ScopeView::add (Chip c)
{
    const bool is_gone = ! c.port.empty() && ! context.names.has (c.port);
    auto& chip = *chips.emplace_back (std::make_unique<FlatButton> (is_gone ? filled (TRANS ("%1 no longer exists"), c.port) : c.text));
    chip.dot = c.dot;
    chip.is_wrong = is_gone;
    if (c.text.length() < 2) chip.setTitle (c.about);   // a symbol means nothing to a screen reader
    chip.setTooltip (c.about);
    // Asynchronous, because the action may delete the chip.
    (c.is_removable ? chip.onCross : chip.onClick) = [safe = juce::Component::SafePointer (this), act = std::move (c.onClick)] {
        juce::MessageManager::callAsync ([safe, act] {
            if (safe != nullptr) act();
        });
    };
    addAndMakeVisible (chip);
}

void ScopeView::changed()
{
    if (context.onChange) context.onChange();
}

void ScopeView::choosePortFor (std::string ScopeSpec::*field)
{
    choosePort (*drawing, context.ports, [safe = juce::Component::SafePointer (this), field] (const std::string& port) {
        if (safe == nullptr) return;
        auto& s = safe->spec;
        s.*field = port;
        if (field == &ScopeSpec::y) s.state = stateFor (port, safe->context.ports);
        s.zoomed.clear();
        safe->changed();
    });
}

void ScopeView::rebuildHeader()
{
    links.clear();
    chips.clear();
    for (auto& a : drawing->actions())
    {
        auto& b = *links.emplace_back (std::make_unique<FlatButton> (a.text));
        b.setTooltip (a.about);
        b.onClick = [&b, click = a.onClick] { click (b); };
        addAndMakeVisible (b);
    }
    switch (spec.kind)
    {
    case ScopeKind::time:
    case ScopeKind::spectrum:
    case ScopeKind::spectrogram:
        addTraceChips();
        break;
    case ScopeKind::over:
    case ScopeKind::energy:
        addAxisChips();
        break;
    case ScopeKind::tool:
        addNodeChip();
        break;
    }
    resized();
    repaint();
}

void ScopeView::addTraceChips()
{
    const auto& theme = themeOf (*this);
    std::map<std::string, std::size_t> ports_of_unit;
    for (const auto& port : spec.ports)
    {
        const auto traces = of (port);
        const auto nth = traces.empty() ? 0 : ports_of_unit[traces.front()->unit()]++;
        const auto dot = traces.empty() ? theme.dim : traceColour (theme, traces.front()->quantity(), nth);
        const auto remove = [this, port] {
            std::erase (spec.ports, port);
            changed();
        };
        add ({ port, port, dot, remove, TRANS ("Click the cross to remove this port"), true });
    }
    const auto addPort = [this] {
        choosePort (*drawing, context.ports, [safe = juce::Component::SafePointer (this)] (const std::string& port) {
            if (safe == nullptr || std::ranges::count (safe->spec.ports, port) > 0) return;
            safe->spec.addPort (port);
            safe->changed();
        });
    };
    const bool replaces = spec.kind == ScopeKind::spectrogram && ! spec.ports.empty();
    add ({ .text = "+", .onClick = addPort, .about = replaces ? TRANS ("Show another port") : TRANS ("Add a port") });
}

void ScopeView::addAxisChips()
{
    const bool is_energy = spec.kind == ScopeKind::energy;
    if (is_energy && spec.x.empty()) return;
    const auto& theme = themeOf (*this);
    const auto chooseY = [this] { choosePortFor (&ScopeSpec::y); };
    const auto chooseX = [this] { choosePortFor (&ScopeSpec::x); };
    if (is_energy)
    {
        add ({ spec.y, spec.y, theme.of (Quantity::force), chooseY, TRANS ("Force on the tool, for the work of the hand; click to change") });
        add ({ spec.x, spec.x, theme.of (Quantity::length), chooseX, TRANS ("Position of the tool; click to change") });
        return;
    }
    add ({ spec.y.empty() ? TRANS ("y: choose") : juce::String (spec.y), spec.y, theme.of (Quantity::force), chooseY, TRANS ("y axis; click to change") });
    add ({ spec.x.empty() ? TRANS ("x: choose") : filled (TRANS ("over %1"), spec.x), spec.x, theme.of (Quantity::length), chooseX,
           TRANS ("x axis; click to change") });
}

void ScopeView::addNodeChip()
{
    if (spec.node.empty()) return;
    const auto choose = [this] {
        juce::PopupMenu menu;
        for (const auto& p : context.ports)
            if (p.port.role == Role::output && p.port.id == "deflection" && p.type.starts_with ("friction."))
                menu.addItem (juce::String (p.path), [safe = juce::Component::SafePointer (this), path = p.path] {
                    if (safe == nullptr) return;
                    safe->spec.node = path;
                    safe->changed();
                });
        menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (*drawing));
    };
    const auto port = spec.node + ".deflection";
    add ({ spec.node, port, themeOf (*this).of (Quantity::force), choose, TRANS ("Friction node; click to change") });
}

void ScopeView::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.fillAll (look.theme().panel);
    const auto font = look.font (12.0f, true);
    g.setFont (font);
    g.setColour (look.theme().text);
    constexpr int least_title = 40;   // units of the window; a shorter rest of the title says nothing
    if (title_area.getWidth() >= least_title) g.drawText (titleOf (spec.kind), title_area.withTrimmedLeft (8), juce::Justification::centredLeft, true);
}

void ScopeView::resized()
{
    auto area = getLocalBounds();
    auto header = area.removeFromTop (header_height).reduced (0, 1);
    header.removeFromRight (4);
    for (auto* b : { close_button.get(), save_button.get(), freeze_button.get() })
        b->setBounds (header.removeFromRight (FlatButton::height));
    const int title_width = static_cast<int> (lookOf (*this).font (12.0f, true).getStringWidthFloat (titleOf (spec.kind))) + 14;
    const bool is_low = getHeight() < low;
    auto row = is_low ? header : area.removeFromTop (chips_height).reduced (0, 1);
    row = row.withTrimmedLeft (2);
    if (is_low)   // the plot is worth more than the title
    {
        int wanted = 0;
        for (const auto& c : chips)
            wanted += c->wantedWidth();
        row.removeFromLeft (std::clamp (row.getWidth() - wanted, 0, title_width));
    }
    title_area = is_low ? header.withRight (row.getX()) : header.removeFromLeft (title_width);
    for (auto& l : links)
    {
        const int width = l->wantedWidth();
        l->setBounds (is_low ? juce::Rectangle<int>() : header.removeFromLeft (width));
        l->setVisible (l->getWidth() == width);   // hidden rather than cut off
    }
    for (auto& c : chips)
    {
        c->setBounds (row.removeFromLeft (std::min (c->wantedWidth(), row.getWidth())));
        c->setVisible (c->getWidth() >= FlatButton::height - 6);
    }
    drawing->setBounds (area.reduced (1, 0));
}

Result<> ScopeView::saveImage (const std::filesystem::path& path)
{
    const auto image = createComponentSnapshot (getLocalBounds(), true, 2.0f);
    juce::MemoryOutputStream bytes;
    if (! juce::PNGImageFormat().writeImageToStream (image, bytes))
        return Message::error ("scope/picture", path.string(), TRANS ("the image could not be created").toStdString(),
                               TRANS ("make the scope larger").toStdString());
    auto file = AtomicFile::create (path);
    if (! file) return file.error();
    if (! file->stream().write (static_cast<const char*> (bytes.getData()), static_cast<std::streamsize> (bytes.getDataSize()))) return file->writeError();
    return file->commit();
}

Result<> ScopeView::saveData (const std::filesystem::path& path)
{
    TraceList all;
    for (const auto& port : portsOf (spec, context.energies))
        for (const auto& t : of (port))
            all.push_back (t);
    for (const auto& t : drawing->made())
        all.push_back (t);
    return writeTraces (path, all);
}

}   // namespace tactus::host
