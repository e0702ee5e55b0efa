// SPDX-License-Identifier: GPL-3.0-or-later
#include "strip.hpp"

#include <host/app/model/controlled_param.hpp>
#include <host/app/model/face.hpp>
#include <host/app/model/message_text.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/graph/text.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr double rms_s = 0.1, spectrum_s = 0.5;
constexpr std::size_t longest_spectrum = 4096;

const PortSheet& sheetOf (const Catalogue& c, std::string_view param)
{
    const auto& params = c.find ("layer.mix")->params;
    return *std::ranges::find (params, param, &PortSheet::id);
}

/// The latest samples of a trace, at most `n`.
void latestOf (const Trace& trace, std::size_t n, double factor, std::vector<double>& into)
{
    const auto from = std::max (trace.begin(), trace.end() - std::min<std::uint64_t> (trace.end(), n));
    into.clear();
    for (auto k = from; k < trace.end(); ++k)
        into.push_back (factor * trace.at (k));
}

juce::Colour inkOf (Quantity q, const Theme& theme) { return q == Quantity::any ? theme.dim : theme.of (q); }
}   // namespace

bool MeterFeed::take (const std::vector<std::shared_ptr<const Trace>>& traces, double factor, double dt_s)
{
    latest.clear();
    std::size_t fresh = 0;
    if (! traces.empty())
    {
        const auto& trace = *traces.front();
        unit = trace.unit();
        quantity = trace.quantity();
        fresh = trace.end() > seen ? static_cast<std::size_t> (trace.end() - seen) : 0;
        // Without new samples, the level is zero.
        if (fresh > 0 || trace.end() < seen) latestOf (trace, static_cast<std::size_t> (rms_s * trace.rate()), factor, latest);
        seen = trace.end();
    }
    meter.take (latest, fresh, dt_s);
    return ! traces.empty();
}

juce::String levelText (double level, const std::string& unit)
{
    if (! (level >= 1e-6)) return juce::String::fromUTF8 ("\xe2\x80\x93");
    const bool small = level < 0.1;
    const double shown = small ? level * 1e3 : level;
    int decimals = 0;
    if (shown < 99.95) decimals = shown < 9.995 ? 2 : 1;
    const auto symbol = juce::String (unit.empty() ? "1" : unit);
    return juce::String (shown, decimals) + ' ' + (small ? "m" + symbol : symbol);
}

void paintMeter (juce::Graphics& g, juce::Rectangle<float> area, const Meter& meter, juce::Colour colour, const Look& look, bool with_scale)
{
    const auto& theme = look.theme();
    const auto bar = area.removeFromLeft (10.0f);
    g.setColour (theme.canvas);
    g.fillRoundedRectangle (bar, 2.0f);
    g.setColour (theme.hairline);
    g.drawRoundedRectangle (bar.reduced (0.5f), 2.0f, 1.0f);
    const auto yOf = [&] (double level) { return bar.getBottom() - bar.getHeight() * static_cast<float> (meterPosition (level)); };
    g.setColour (colour);
    g.fillRoundedRectangle (bar.reduced (1.5f, 1.0f).withTop (std::min (bar.getBottom() - 1.0f, yOf (meter.rms()))), 1.5f);
    if (meter.peak() > 1e-3) g.fillRect (bar.withHeight (2.0f).withCentre ({ bar.getCentreX(), std::max (bar.getY() + 1.0f, yOf (meter.peak())) }));
    if (! with_scale) return;

    static constexpr std::array<std::pair<double, const char*>, 5> marks { { { 10.0, "10" }, { 1.0, "1" }, { 0.1, "0.1" }, { 0.01, "10m" }, { 0.001, "1m" } } };
    g.setFont (look.font (11.0f));
    float last = -100.0f;
    for (const auto& [level, text] : marks)
    {
        const float y = std::clamp (yOf (level), bar.getY() + 5.0f, bar.getBottom() - 5.0f);
        if (y - last < 12.0f) continue;
        last = y;
        g.setColour (theme.hairline);
        g.fillRect (area.getX() + 2.0f, yOf (level) - 0.5f, 4.0f, 1.0f);
        g.setColour (theme.dim);
        g.drawText (text, juce::Rectangle<float> (area.getX() + 8.0f, y - 7.0f, area.getWidth() - 8.0f, 14.0f), juce::Justification::centredLeft, false);
    }
}

//==============================================================================
void NameLabel::paint (juce::Graphics& g)
{
    if (isBeingEdited()) return;
    const auto& look = lookOf (*this);
    g.setFont (look.font (13.0f, true));
    g.setColour (look.theme().text);
    g.drawText (getText(), getLocalBounds().reduced (4, 0), juce::Justification::centredLeft, true);
}

//==============================================================================
LayerStrip::LayerStrip (std::shared_ptr<const MixerContext> c, int i)
    : context (std::move (c)), layer (i), gain_field (sheetOf (context->catalogue, "gain")), priority (sheetOf (context->catalogue, "priority"))
{
    name.setEditable (false, true, false);
    name.setBorderSize ({ 0, 4, 0, 4 });
    source.setJustification (juce::Justification::centredLeft);
    name.setTooltip ("Double-click to rename, drag to move");
    name.onTextChange = [this] { rename (name.getText()); };
    name.addMouseListener (this, false);
    source.onClick = [this] {
        if (wired && context->select) context->select (context->place.patch, fed_by);
    };
    close.onClick = [this] { remove(); };
    mute.setColour ([] (const Theme& t) { return t.warning; });
    const auto flip = [this] (const char* param, const ToolButton& b) { setValue (param, b.getToggleState() ? std::nullopt : std::optional<Json> (1), false); };
    mute.onClick = [this, flip] { flip ("mute", mute); };
    solo.onClick = [this, flip] { flip ("solo", solo); };
    fader.onChange = [this] (std::optional<double> to, bool goes_on) { setGain (to ? std::optional<Json> (*to) : std::nullopt, goes_on); };
    fader.onTextEntry = [this] { gain_field.openEditor(); };
    gain_field.onChange = [this] (std::optional<Json> to, bool goes_on) { setGain (std::move (to), goes_on); };
    priority.onChange = [this] (std::optional<Json> to, bool goes_on) { setValue ("priority", std::move (to), goes_on); };
    gain_field.setCaption ("gain");
    priority.setCaption ("P");
    gain_field.onRefused = priority.onRefused = context->hint;
    priority.setTooltip ("Priority. " + tooltipOf (sheetOf (context->catalogue, "priority")));
    for (auto* child : std::initializer_list<juce::Component*> { &name, &source, &mute, &solo, &fader, &gain_field, &priority, &close })
        addAndMakeVisible (child);
    show();
}

double LayerStrip::numberOf (const graph::Node& node, const std::string& param) const
{
    return siOf (layerValue (node, context->catalogue, param, layer), sheetOf (context->catalogue, param));
}

bool LayerStrip::isOn (const graph::Node& node, const std::string& param) const { return numberOf (node, param) > 0.5; }

void LayerStrip::show()
{
    const auto* node = context->node();
    if (node == nullptr) return;
    const auto& graph = context->document.graph();
    const int layers = layersOf (*node, context->catalogue);
    if (layer >= layers) return;
    const auto label = layerNames (*node, layers)[static_cast<std::size_t> (layer)];
    if (! name.isBeingEdited()) name.setText (label.empty() ? "Layer " + juce::String (layer + 1) : juce::String (label), juce::dontSendNotification);

    const auto held = controlOf (graph, pathOf ("gain"));
    held_by = held ? juce::String (held->name) : juce::String();
    const auto written = held ? Json (std::round (held->value * 1e4) * 1e-4) : layerValue (*node, context->catalogue, "gain", layer);
    gain_field.show (written);
    gain = gain_field.shown().si();
    fader.show (gain);
    const auto note = held ? "\nThe control " + held_by + " sets this gain. A change of the gain here moves the control." : juce::String();
    fader.setTooltip ("Gain. Drag to change, with Shift for fine steps; double-click to type; Alt-click to reset to 1" + note);
    gain_field.setTooltip (tooltipOf (sheetOf (context->catalogue, "gain")) + note);
    gain_field.setBold (held || gain != 1.0);
    priority.show (layerValue (*node, context->catalogue, "priority", layer));
    mute.setToggleState (isOn (*node, "mute"), juce::dontSendNotification);
    solo.setToggleState (isOn (*node, "solo"), juce::dontSendNotification);

    heard = ! mute.getToggleState();
    if (const auto solos = node->params.find ("solo"); heard && solos != node->params.end() && solos->is_array())
        heard = solo.getToggleState() || std::ranges::none_of (*solos, [] (const Json& v) { return v.is_number() && v.get<double>() > 0.5; });

    const auto* w = wireInto (graph, context->place, layer);
    const auto* patch = context->place.patch.empty() ? &graph.root : graph.find (context->place.patch);
    const auto* from = w == nullptr || patch == nullptr ? nullptr : patch->find (graph::firstNameOf (w->from.node));
    wired = from != nullptr;
    fed_by = wired ? from->id : 0;
    source.setButtonText (wired ? juce::String (graph::toText (w->from)) : "not wired");
    source.setTooltip (wired ? "Input: " + juce::String (graph::toText (w->from)) + "; click to select it"
                             : "Draw a wire into " + juce::String (context->place.node) + ".in[" + juce::String (layer) + "]");
    if (wired && feed.quantity == Quantity::any)
        if (const auto face = faceOf (graph, *patch, *from, context->catalogue); const auto* port = face.startOf (w->from)) feed.quantity = port->quantity();
    repaint();
}

void LayerStrip::setGain (std::optional<Json> to, bool goes_on)
{
    if (const auto held = controlOf (context->document.graph(), pathOf ("gain")))
    {
        // The range of the control limits the fader.
        const auto [low, high] = std::minmax (held->low, held->high);
        const double wanted = std::clamp (siOf (to.value_or (Json (1.0)), sheetOf (context->catalogue, "gain"), 1.0), low, high);
        if (auto command = moveControlFor (context->document.graph(), *held, wanted))
            context->perform (std::move (*command), goes_on);
        else
            show();
        return;
    }
    setValue ("gain", std::move (to), goes_on);
}

void LayerStrip::setValue (const std::string& param, std::optional<Json> to, bool goes_on)
{
    if (const auto* node = context->node()) context->perform (setLayerValue (*node, context->place, context->catalogue, param, layer, to), goes_on);
}

void LayerStrip::rename (const juce::String& to)
{
    const auto* node = context->node();
    if (node == nullptr) return;
    const int layers = layersOf (*node, context->catalogue);
    auto before = layerNames (*node, layers)[static_cast<std::size_t> (layer)];
    if (before == to.trim().toStdString()) return;
    context->perform (renameLayer (*node, context->place, layers, layer, to.toStdString()));
}

void LayerStrip::remove()
{
    auto command = removeLayer (context->document.graph(), context->place, context->catalogue, layer);
    if (! command)
    {
        if (context->hint) context->hint (juce::String (messageText (command.error())));
        return;
    }
    // Asynchronous, because the command deletes this strip, whose button is being clicked.
    juce::MessageManager::callAsync ([safe = juce::Component::SafePointer (this), command = *std::move (command)] {
        if (safe != nullptr) std::shared_ptr (safe->context)->perform (command);
    });
}

void LayerStrip::refresh (const Traces::Client& traces, double dt_s, bool with_spectrum)
{
    const auto found = traces.of (context->place.path + ".in[" + std::to_string (layer) + ']');
    const auto peak = feed.meter.peak(), rms = feed.meter.rms();
    feed.take (found, gain, dt_s);
    if (feed.meter.peak() != peak || feed.meter.rms() != rms)
    {
        repaint (meter_area);
        repaint (peak_area);
    }
    if (! with_spectrum || spectrum_area.isEmpty()) return;
    std::vector<double> samples;
    if (! found.empty())
    {
        std::size_t n = 256;
        while (n < longest_spectrum && static_cast<double> (n) < spectrum_s * found.front()->rate())
            n *= 2;
        if (feed.meter.rms() > 0.0) latestOf (*found.front(), n, gain, samples);
    }
    spectrum = bandsOf (samples, found.empty() ? 0.0 : found.front()->rate());
    repaint (spectrum_area);
}

void LayerStrip::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    auto area = getLocalBounds().toFloat();
    g.setColour (theme.hairline);
    g.fillRect (area.removeFromRight (1.0f));

    const auto ink = inkOf (feed.quantity, theme);
    const auto colour = heard ? ink : theme.dim.withAlpha (0.5f);
    g.setColour (wired ? ink : theme.dim.withAlpha (0.5f));
    const auto chip = source.getBounds().toFloat();
    const auto dot = juce::Rectangle<float> (7.0f, 7.0f).withCentre ({ chip.getX() - 5.0f, chip.getCentreY() });
    wired ? g.fillEllipse (dot) : g.drawEllipse (dot.reduced (0.5f), 1.0f);

    if (! spectrum_area.isEmpty())
    {
        const auto box = spectrum_area.toFloat();
        g.setColour (theme.canvas);
        g.fillRoundedRectangle (box, 3.0f);
        const float each = (box.getWidth() - 4.0f) / Bands::count;
        g.setColour (colour);
        for (int b = 0; b < Bands::count; ++b)
        {
            // The height shows the amplitude over four decades, as in the meter.
            const auto h = static_cast<float> (meterPosition (std::sqrt (2.0 * spectrum.power[static_cast<std::size_t> (b)]))) * (box.getHeight() - 4.0f);
            g.fillRect (box.getX() + 2.0f + each * static_cast<float> (b), box.getBottom() - 2.0f - h, each - 0.8f, h);
        }
    }
    paintMeter (g, meter_area.toFloat(), feed.meter, colour, look, true);
    g.setFont (look.font (11.0f));
    g.setColour (theme.dim);
    drawNumber (g, levelText (feed.meter.peak(), feed.unit), peak_area.toFloat());
    if (held_by.isNotEmpty())
    {
        g.setColour (theme.accent);
        const auto field = gain_field.getBounds().toFloat();
        g.fillEllipse (juce::Rectangle<float> (5.0f, 5.0f).withCentre ({ field.getX() + 8.0f, field.getCentreY() }));
    }
}

void LayerStrip::resized()
{
    auto area = getLocalBounds().withTrimmedRight (1).reduced (8, 4);
    auto top = area.removeFromTop (24);
    close.setBounds (top.removeFromRight (24));
    name.setBounds (top.withTrimmedLeft (-4));
    source.setBounds (area.removeFromTop (20).withTrimmedLeft (10));
    auto switches = area.removeFromBottom (24);
    mute.setBounds (switches.removeFromLeft (28).reduced (1, 0));
    solo.setBounds (switches.removeFromLeft (28).reduced (1, 0));
    priority.setBounds (switches.withTrimmedLeft (2));
    area.removeFromBottom (4);
    gain_field.setBounds (area.removeFromBottom (24));
    area.removeFromBottom (2);
    spectrum_area = area.getHeight() >= 104 ? area.removeFromTop (28) : juce::Rectangle<int>();
    if (! spectrum_area.isEmpty()) area.removeFromTop (4);
    fader.setVisible (area.getHeight() >= 40);
    auto right = area.removeFromRight (50);
    peak_area = area.getHeight() >= 72 ? right.removeFromBottom (14) : juce::Rectangle<int>();
    meter_area = right.withTrimmedLeft (4);
    fader.setBounds (area.reduced (4, 0));
}

void LayerStrip::mouseDrag (const juce::MouseEvent& e)
{
    if (e.eventComponent != &name || e.getDistanceFromDragStart() < 6 || ! context->drag) return;
    moving = true;
    context->drag (layer, e.getEventRelativeTo (getParentComponent()).x, false);
}

void LayerStrip::mouseUp (const juce::MouseEvent& e)
{
    if (! std::exchange (moving, false)) return;
    context->drag (layer, e.getEventRelativeTo (getParentComponent()).x, true);
}

//==============================================================================
MixStrip::MixStrip (std::shared_ptr<const MixerContext> c)
    : context (std::move (c)), duck (sheetOf (context->catalogue, "duck_db")), ceiling (sheetOf (context->catalogue, "ceiling"))
{
    const auto bind = [this] (NumberField& field, const char* param) {
        field.onChange = [this, param] (std::optional<Json> to, bool continues) {
            const auto& at = context->place;
            context->perform (graph::SetParam { at.patch, at.node, param, std::move (to) }, continues);
        };
        field.onRefused = context->hint;
        addAndMakeVisible (field);
    };
    bind (duck, "duck_db");
    bind (ceiling, "ceiling");
    show();
}

void MixStrip::show()
{
    const auto* node = context->node();
    if (node == nullptr) return;
    const auto value = [&] (const char* param) {
        const auto own = node->params.find (param);
        return own != node->params.end() ? Json (*own) : Json (sheetOf (context->catalogue, param).initial[0]);
    };
    duck.show (value ("duck_db"));
    duck.setBold (node->params.contains ("duck_db"));
    ceiling.show (value ("ceiling"));
    ceiling.setBold (node->params.contains ("ceiling"));
    limits = ceiling.shown().si() > 0.0;
    repaint();
}

void MixStrip::refresh (const Traces::Client& traces, double dt_s)
{
    const auto before = over_db;
    const auto shown_peak = std::exchange (peak, levelText (feed.meter.peak(), feed.unit));
    feed.take (traces.of (context->place.path + ".out"), 1.0, dt_s);
    over_db = 0.0;
    if (const auto found = traces.of (context->place.path + ".reduction"); ! found.empty())
    {
        std::vector<double> latest;
        latestOf (*found.front(), static_cast<std::size_t> (0.3 * found.front()->rate()), 1.0, latest);
        for (const double v : latest)
            if (v > over_db) over_db = v;
    }
    repaint (meter_area);
    if (before != over_db || shown_peak != peak) repaint (text_area);
}

void MixStrip::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.fillAll (theme.canvas.interpolatedWith (theme.panel, 0.5f));
    auto area = getLocalBounds().reduced (12, 4).toFloat();
    g.setFont (look.font (13.0f, true));
    g.setColour (theme.text);
    g.drawText ("Mix", area.removeFromTop (24.0f), juce::Justification::centredLeft, false);
    const bool over = over_db > 0.05;
    paintMeter (g, meter_area.toFloat(), feed.meter, over ? theme.warning : inkOf (feed.quantity, theme), look, true);
    g.setFont (look.font (12.0f));
    g.setColour (theme.dim);
    g.drawText ("ducking", duck_label, juce::Justification::centredLeft, false);
    g.drawText ("ceiling", ceiling_label, juce::Justification::centredLeft, false);
    auto lines = text_area;
    g.setColour (theme.text);
    g.drawText ("peak " + peak, lines.removeFromTop (18), juce::Justification::centredLeft, false);
    juce::String state = limits ? "below the ceiling" : "no ceiling";
    if (limits && over) state = "over by " + juce::String (over_db, 1) + " dB";
    g.setColour (over ? theme.warning : theme.dim);
    g.drawText (state, lines.removeFromTop (18), juce::Justification::centredLeft, false);
}

void MixStrip::resized()
{
    auto area = getLocalBounds().reduced (12, 4).withTrimmedTop (28);
    meter_area = area.removeFromLeft (46);
    area.removeFromLeft (4);
    const bool tall = area.getHeight() >= 148;
    duck_label = tall ? area.removeFromTop (16) : juce::Rectangle<int>();
    duck.setBounds (area.removeFromTop (24));
    area.removeFromTop (4);
    ceiling_label = tall ? area.removeFromTop (16) : juce::Rectangle<int>();
    ceiling.setBounds (area.removeFromTop (24));
    area.removeFromTop (4);
    text_area = area;
}

}   // namespace tactus::host
