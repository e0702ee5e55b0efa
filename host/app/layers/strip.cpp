// SPDX-License-Identifier: GPL-3.0-or-later
#include "strip.hpp"

#include <host/app/model/controlled_param.hpp>
#include <host/app/model/face.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/endpoints.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

void MixerContext::perform (Result<graph::Command> command) const
{
    if (command)
        document.perform (*std::move (command));
    else if (hint)
        hint (juce::String (messageText (command.error())));
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
    : context (std::move (c)), layer (i), priority (mixerSheet (context->catalogue, "priority"))
{
    name.setEditable (false, true, false);
    name.setBorderSize ({ 0, 4, 0, 4 });
    source.setJustification (juce::Justification::centredLeft);
    send.setJustification (juce::Justification::centredLeft);
    name.setTooltip (TRANS ("Double-click to rename, drag to move"));
    name.onTextChange = [this] { rename (name.getText()); };
    name.addMouseListener (this, false);
    source.onClick = [this] {
        if (wired && context->select) context->select (context->place.patch, fed_by);
    };
    close.onClick = [this] { remove(); };
    mute.setColour ([] (const Theme& t) { return t.warning; });
    mute.onClick = [this] { flip ("mute", mute.getToggleState()); };
    solo.onClick = [this] { flip ("solo", solo.getToggleState()); };
    gate.onClick = [this] { setGate (! gate.getToggleState()); };
    send.onClick = [this] { openSends(); };
    connectFields();
    const std::initializer_list<juce::Component*> parts { &name, &source, &close, &fader, &gain_field, &send, &send_gain, &mute, &solo, &gate, &priority };
    for (auto* part : parts)
        addAndMakeVisible (part);
    show();
}

void LayerStrip::connectFields()
{
    fader.onChange = [this] (std::optional<double> to, bool goes_on) {
        const auto& history = context->document.history();
        setGain (to ? std::optional<Json> (*to) : std::nullopt, goes_on && history.position() == fader_step);
        fader_step = history.position();
    };
    gain_field.read = [this] (const std::string& text) { return readGain (text, unityLevel()); };
    gain_field.onChange = [this] (const std::optional<Json>& db, bool goes_on) {
        if (! db) return setGain (std::nullopt, goes_on);
        setGain (Json (std::copysign (gainOf (siOf (*db, decibelSheet())), gain)), goes_on);   // an inverted layer stays inverted
    };
    send_gain.read = [] (const std::string& text) { return readGain (text, {}); };
    send_gain.onChange = [this] (const std::optional<Json>& db, bool goes_on) { setSendGain (db ? siOf (*db, decibelSheet()) : 0.0, goes_on); };
    priority.onChange = [this] (const std::optional<Json>& to, bool goes_on) { setValue ("priority", to, goes_on); };
    priority.setCaption (TRANS ("P"));
    gain_field.onRefused = priority.onRefused = send_gain.onRefused = context->hint;
    priority.setTooltip (TRANS ("Priority") + ". " + tooltipOf (mixerSheet (context->catalogue, "priority")));
    send_gain.setTooltip (TRANS ("Gain of the send, before the gain, mute and solo of this layer"));
}

double LayerStrip::numberNow (const graph::Node& node, const std::string& param, int of_layer) const
{
    if (const auto held = controlOf (context->document.graph(), pathOf (param, of_layer))) return held->value;
    return siOf (layerValue (node, context->catalogue, param, of_layer), mixerSheet (context->catalogue, param));
}

void LayerStrip::show()
{
    const auto* node = context->node();
    if (node == nullptr) return;
    const auto& graph = context->document.graph();
    const int layers = layersOf (*node, context->catalogue);
    if (layer >= layers) return;
    const auto written_name = layerNames (*node, layers)[static_cast<std::size_t> (layer)];
    const auto label = written_name.empty() ? filled (TRANS ("Layer %1"), layer + 1) : juce::String (written_name);
    if (! name.isBeingEdited()) name.setText (label, juce::dontSendNotification);
    nameControls (label);

    const auto held = controlOf (graph, pathOf ("gain", layer));
    held_by = held ? juce::String (held->name) : juce::String();
    gain = numberNow (*node, "gain", layer);
    driver = driverAt (graph, pathOf ("gain", layer));
    gain_field.setDriver (driver);
    gain_field.show (Json (decibelsOf (gain)));
    fader.show (gain);
    fader.setAlpha (driver.empty() ? 1.0f : 0.4f);
    auto note = held ? "\n" + filled (TRANS ("The control %1 sets this gain. A change of the gain here moves the control."), held_by) : juce::String();
    if (! driver.empty()) note = "\n" + drivenText (driver);
    if (gain < 0.0) note << "\n" + TRANS ("The layer is inverted: its gain is negative.");
    fader.setTooltip (TRANS ("Gain. Drag to change, with Shift for fine steps; double-click for 0 dB; Alt+click for the default") + note);
    gain_field.setTooltip (TRANS ("Gain. Type -6 dB, x0.5, 50 %, off, or the level you want, such as 0.3 N") + note);
    gain_field.setBold (held || gain != 1.0);
    const auto ranked = controlOf (graph, pathOf ("priority", layer));
    priority.setDriver (driverAt (graph, pathOf ("priority", layer)));
    priority.show (ranked ? valueOf (*ranked, mixerSheet (context->catalogue, "priority")) : layerValue (*node, context->catalogue, "priority", layer));
    showSwitches (*node);
    showSource();
    showSends();
    repaint();
}

void LayerStrip::showSwitches (const graph::Node& node)
{
    const auto isOn = [&] (const char* param, int i) { return numberNow (node, param, i) > 0.5; };   // as the mixer does
    mute.setToggleState (isOn ("mute", layer), juce::dontSendNotification);
    solo.setToggleState (isOn ("solo", layer), juce::dontSendNotification);
    gate.setToggleState (isGated (context->document.graph(), context->place, layer), juce::dontSendNotification);
    bool any_solo = false;
    for (int i = 0; i < layersOf (node, context->catalogue); ++i)
        any_solo = any_solo || isOn ("solo", i);
    heard = ! mute.getToggleState() && (! any_solo || solo.getToggleState());
}

void LayerStrip::showSource()
{
    const auto& graph = context->document.graph();
    const auto* w = wireInto (graph, context->place, layer);
    const auto* patch = context->place.patch.empty() ? &graph.root : graph.find (context->place.patch);
    const auto* from = w == nullptr || patch == nullptr ? nullptr : patch->find (graph::firstNameOf (w->from.node));
    wired = from != nullptr;
    fed_by = wired ? from->id : 0;
    source.setButtonText (wired ? juce::String (graph::toText (w->from)) : TRANS ("not wired"));
    gate.setEnabled (wired);
    send.setEnabled (wired);
    close.setTooltip (context->completeRemoval && onlySource() != nullptr ? TRANS ("Remove this layer, the node that feeds it, and its knobs")
                                                                          : TRANS ("Remove this layer and its wires"));
    if (! wired)
    {
        source.setTooltip (filled (TRANS ("Draw a wire into %1"), juce::String (context->place.node) + ".in[" + juce::String (layer) + "]"));
        return;
    }
    static constexpr std::array axes { "x", "y", "z" };
    const auto input = w->to.component < 0 ? TRANS ("Input: %1; click to select it") : TRANS ("Input: %1 along %2; click to select it");
    source.setTooltip (filled (input, graph::toText (w->from), axes[static_cast<std::size_t> (std::max (0, w->to.component))]));
    const auto face = faceOf (graph, *patch, *from, context->catalogue);
    const auto* port = face.startOf (w->from);
    if (port != nullptr && port->quantity() != Quantity::any) feed.quantity = port->quantity();
    if (context->place.vectors) feed.quantity = Quantity::force;
    if (feed.unit.empty()) feed.unit = unitOfLayer (graph, context->place, context->catalogue, layer);
}

void LayerStrip::showSends()
{
    sends = sendsOf (context->document.graph(), context->place, context->catalogue, layer);
    const auto more = sends.size() > 1 ? " +" + juce::String (sends.size() - 1) : juce::String();
    send.setButtonText (sends.empty() ? TRANS ("Send...") : juce::String::fromUTF8 ("\xe2\x86\x92") + sends.front().to.name + more);
    send.setTooltip (TRANS ("Send this layer to another device, too"));
    if (sends.empty() == send_gain.isVisible()) resized();
    if (sends.empty()) return;
    if (const auto* bus = findMixer (context->document.graph(), sends.front().bus))
        send_gain.show (Json (decibelsOf (siOf (layerValue (*bus, context->catalogue, "gain", sends.front().layer), mixerSheet (context->catalogue, "gain")))));
}

void LayerStrip::nameControls (const juce::String& label)
{
    name.setTitle (filled (TRANS ("Name of the layer %1"), label));
    source.setTitle (filled (TRANS ("Input of %1"), label));
    close.setTitle (filled (TRANS ("Remove %1"), label));
    mute.setTitle (filled (TRANS ("Mute %1"), label));
    solo.setTitle (filled (TRANS ("Solo %1"), label));
    gate.setTitle (filled (TRANS ("Feel %1 only in contact"), label));
    send.setTitle (filled (TRANS ("Send %1 to another device"), label));
    fader.setTitle (filled (TRANS ("Gain of %1"), label));
    gain_field.setTitle (filled (TRANS ("Gain of %1 in dB"), label));
    send_gain.setTitle (filled (TRANS ("Gain of the send of %1 in dB"), label));
    priority.setTitle (filled (TRANS ("Priority of %1"), label));
}

UnityLevel LayerStrip::unityLevel() const { return { unity_peak, feed.unit }; }

void LayerStrip::typeGain (const juce::String& text) { gain_field.type (text); }

void LayerStrip::setGate (bool on) { context->perform (host::setGate (context->document.graph(), context->place, context->catalogue, layer, on)); }

void LayerStrip::sendTo (const std::string& sink)
{
    const auto& graph = context->document.graph();
    const auto present = std::ranges::find (sends, sink, [] (const Send& s) { return s.to.sink; });
    if (present != sends.end())
        context->perform (removeSend (graph, *present, context->catalogue));
    else if (sink.empty())
        context->perform (addSendToNewMotor (graph, context->place, context->catalogue, layer));
    else
        context->perform (addSend (graph, context->place, context->catalogue, layer, sink));
}

void LayerStrip::setSendGain (double decibels, bool goes_on)
{
    if (sends.empty()) return;
    const auto& to = sends.front();
    if (const auto* bus = findMixer (context->document.graph(), to.bus))
        context->perform (setLayerValue (*bus, to.bus, context->catalogue, "gain", to.layer, Json (gainOf (decibels))), goes_on);
}

void LayerStrip::openSends()
{
    juce::PopupMenu menu;
    std::vector<std::string> sinks;
    for (const auto& t : sendTargets (context->document.graph(), context->place))
    {
        sinks.push_back (t.sink);
        const bool is_sent = std::ranges::any_of (sends, [&] (const Send& s) { return s.to.sink == t.sink; });
        menu.addItem (static_cast<int> (sinks.size()), t.name + " (" + t.sink + ")", true, is_sent);
    }
    if (! sinks.empty()) menu.addSeparator();
    sinks.emplace_back();
    menu.addItem (static_cast<int> (sinks.size()), TRANS ("A new vibration motor"));
    menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (send), [safe = juce::Component::SafePointer (this), sinks] (int item) {
        if (safe != nullptr && item > 0) safe->sendTo (sinks[static_cast<std::size_t> (item - 1)]);
    });
}

void LayerStrip::setGain (const std::optional<Json>& to, bool goes_on) { setValue ("gain", to, goes_on); }

void LayerStrip::setValue (const std::string& param, const std::optional<Json>& to, bool goes_on)
{
    const auto* node = context->node();
    if (node == nullptr) return;
    const auto& graph = context->document.graph();
    const auto path = pathOf (param, layer);
    if (const auto output = driverAt (graph, path); ! output.empty())
    {
        if (context->hint) context->hint (drivenText (output));
        return show();
    }
    const auto held = controlOf (graph, path);
    if (! held) return context->perform (setLayerValue (*node, context->place, context->catalogue, param, layer, to), goes_on);
    // The range of the control limits the value.
    const auto [low, high] = std::minmax (held->low, held->high);
    const auto& sheet = mixerSheet (context->catalogue, param);
    const double wanted = std::clamp (siOf (to.value_or (Json (sheet.initial[0])), sheet, sheet.initial[0]), low, high);
    if (auto command = moveControlFor (graph, *held, wanted))
        context->perform (std::move (*command), goes_on);
    else
        show();
}

void LayerStrip::flip (const std::string& param, bool is_on)
{
    const auto held = controlOf (context->document.graph(), pathOf (param, layer));
    const bool can = ! held || (is_on ? std::min (held->low, held->high) <= 0.5 : std::max (held->low, held->high) > 0.5);
    if (can) return setValue (param, is_on ? std::nullopt : std::optional<Json> (1), false);
    if (context->hint) context->hint (filled (TRANS ("the new value of %1 is outside the range of the control %2"), param, held->name));
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

/// A subgraph that feeds this layer and nothing else, such as an added preset; null if there is none.
const graph::Node* LayerStrip::onlySource() const
{
    const auto& g = context->document.graph();
    const auto* wire = wireInto (g, context->place, layer);
    const auto* patch = findPatch (g, context->place.patch);
    if (wire == nullptr || patch == nullptr) return nullptr;
    const auto name = graph::firstNameOf (wire->from.node);
    const auto* node = patch->find (name);
    const auto isFrom = [&] (const graph::Wire& w) { return graph::firstNameOf (w.from.node) == name; };
    const auto isInto = [&] (const graph::Wire& w) { return w.to.node == wire->to.node && w.to.port == wire->to.port && w.to.index == wire->to.index; };
    const bool is_alone = std::ranges::count_if (patch->wires, isFrom) == 1 && std::ranges::count_if (patch->wires, isInto) == 1;
    return node != nullptr && node->type.starts_with ("graph:") && is_alone ? node : nullptr;
}

/// An added preset goes with its layer.
void LayerStrip::remove()
{
    auto command = removeLayer (context->document.graph(), context->place, context->catalogue, layer);
    if (const auto* node = onlySource(); command && node != nullptr && context->completeRemoval)
        command = context->completeRemoval ({ NEEDS_TRANS ("remove a layer"), { graph::RemoveNode { context->place.patch, node->name } } });
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
    const auto port = [this] (const char* list) { return context->place.path + list + std::to_string (layer) + ']'; };
    const auto found = traces.of (port (".in["));
    const auto level = found.empty() ? traces.of (port (".level[")) : found;
    const auto peak = feed.meter.peak(), rms = feed.meter.rms();
    const auto quantity = feed.quantity;
    feed.take (level, found.empty() ? 1.0 : gain, dt_s);   // the level is that after the gain
    if (feed.has_changed) unity_peak = 0.0;
    if (const double divisor = found.empty() ? std::abs (gain) : 1.0; divisor > 0.0) unity_peak = std::max (unity_peak, feed.newest / divisor);
    if (feed.quantity != quantity) repaint();   // its colour is everywhere
    if (feed.meter.peak() != peak || feed.meter.rms() != rms)
    {
        repaint (meter_area);
        repaint (peak_area);
    }
    if (! with_spectrum || spectrum_area.isEmpty()) return;
    has_spectrum = ! found.empty();
    spectrum = feed.meter.rms() > 0.0 ? bandsOfPort (found, gain) : Bands {};
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

    if (has_spectrum && ! spectrum_area.isEmpty())
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
    paintMeter (g, meter_area.toFloat(), feed.meter, colour, look, feed.unit);
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
    for (auto* b : { &mute, &solo, &gate })
        b->setBounds (switches.removeFromLeft (25).reduced (1, 0));
    priority.setBounds (switches.withTrimmedLeft (2));
    area.removeFromBottom (4);
    placeGains (area);
    spectrum_area = area.getHeight() >= 92 ? area.removeFromTop (24) : juce::Rectangle<int>();
    if (! spectrum_area.isEmpty()) area.removeFromTop (4);
    fader.setVisible (area.getHeight() >= 40);
    auto right = area.removeFromRight (60);
    peak_area = area.getHeight() >= 60 ? right.removeFromBottom (16).withTrimmedTop (2) : juce::Rectangle<int>();
    meter_area = right.withTrimmedLeft (4);
    fader.setBounds (area.withSizeKeepingCentre (std::min (area.getWidth() - 8, 40), area.getHeight()));
}

/// The gain of the layer, with the button for sends next to it. A layer that is sent has one more line, with the gain of the send.
void LayerStrip::placeGains (juce::Rectangle<int>& area)
{
    send.setVisible (area.getHeight() >= 100);
    send_gain.setVisible (send.isVisible() && ! sends.empty());
    if (send_gain.isVisible())
    {
        auto line = area.removeFromBottom (24);
        send_gain.setBounds (line.removeFromRight (48));
        send.setBounds (line.withTrimmedLeft (-4));
        area.removeFromBottom (2);
    }
    auto line = area.removeFromBottom (24);
    if (send.isVisible() && ! send_gain.isVisible()) send.setBounds (line.removeFromRight (48).withTrimmedLeft (2));
    gain_field.setBounds (line);
    area.removeFromBottom (2);
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

}   // namespace tactus::host
