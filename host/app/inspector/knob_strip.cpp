// SPDX-License-Identifier: GPL-3.0-or-later
#include "knob_strip.hpp"
#include "control_value.hpp"
#include "modulator_menu.hpp"

#include <host/app/inspector/blocks/depth_ring.hpp>
#include <host/app/inspector/blocks/fields.hpp>
#include <host/app/look/drag_way.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr int knob_width = 68, knob_height = 64, label_height = 16, strip_margin = 8;
constexpr double scale_start = 1.25, scale_end = 2.75;   // of the scale, in half turns from the top
}   // namespace

/// A control: a dial with its name and its value.
class KnobStrip::Knob final : public juce::Slider
{
public:
    Knob (KnobStrip& s, std::string i) : juce::Slider (RotaryHorizontalVerticalDrag, NoTextBox), strip (s), document (s.document), id (std::move (i))
    {
        getProperties().set (shown_control, fromUtf8 (id));
        setRange (0.0, 1.0);
        setNumDecimalPlacesToDisplay (2);
        setWantsKeyboardFocus (true);
        setMouseClickGrabsKeyboardFocus (false);   // the canvas keeps the keyboard focus
        valueFromTextFunction = [this] (const juce::String& text) {
            const auto to = readControl (text.toStdString());
            return to ? *to : getValue();
        };
        onValueChange = [this] {   // by a screen reader
            if (! refusesHand()) change (getValue(), false);
        };
    }

    const std::string& control() const noexcept { return id; }

    void refresh()
    {
        const auto* c = find();
        if (c == nullptr) return;
        name = fromUtf8 (c->name.empty() ? c->id : c->name);
        setTitle (name);
        overridden = overriddenText (document.graph(), *c);
        has_no_effect = isOverridden (document.graph(), *c);
        const auto usual = filled (TRANS ("%1: drag up or down, Shift+drag for fine steps; double-click to type a value, or on the name to rename it"), name);
        auto about = has_no_effect ? name + ": " + overridden : usual + (overridden.isEmpty() ? "" : "\n" + overridden);
        findDepths (*c);
        for (const auto& d : depths)
            about << "\n"
                  << fromUtf8 (d.path) << ": " << textOf (d.modulation);
        if (! depths.empty()) about << "\n"
                                    << TRANS ("Drag the ring around the knob to change this; drag it to 0 to end it.");
        setTooltip (about);
        setValue (c->value, juce::dontSendNotification);
        repaint();
    }

    bool keyPressed (const juce::KeyPress& key) override
    {
        const bool is_up = key.isKeyCode (juce::KeyPress::upKey) || key.isKeyCode (juce::KeyPress::rightKey);
        const bool is_down = key.isKeyCode (juce::KeyPress::downKey) || key.isKeyCode (juce::KeyPress::leftKey);
        const bool is_digit = isTypedNumber (key);
        if (! is_up && ! is_down && ! is_digit && ! isErasing (key) && ! key.isKeyCode (juce::KeyPress::returnKey)) return false;
        if (refusesHand()) return true;
        if (! is_up && ! is_down)
        {
            typeValue();
            if (isErasing (key)) field->clear();
            if (is_digit) field->insertTextAtCaret (juce::String::charToString (key.getTextCharacter()));
            field->onReturnKey = [this] {
                field->apply();
                takeFocus (*this);   // for the next key
            };
            return true;
        }
        const double by = key.getModifiers().isShiftDown() ? 0.001 : 0.01;
        change (std::clamp (getValue() + (is_up ? by : -by), 0.0, 1.0), false);
        return true;
    }

    void mouseDoubleClick (const juce::MouseEvent& e) override
    {
        if (e.y >= getHeight() - label_height) return rename();
        if (! refusesHand()) typeValue();
    }

    void mouseDown (const juce::MouseEvent& e) override
    {
        holds_ring = isOnRing (e.position) && ! e.mods.isPopupMenu();
        part_grabbed = holds_ring ? depths.front().part : 0.0;
        if (e.mods.isPopupMenu()) return showMenu();
        if (! holds_ring) refusesHand();
        grabbed = getValue();
        way = {};
        continues = false;
    }

    void mouseDrag (const juce::MouseEvent& e) override
    {
        constexpr double pixels = 200.0;   // over the whole range
        if (holds_ring) return turnDepth (way.to (e));
        if (! has_no_effect && ! e.mods.isPopupMenu()) turnTo (grabbed + way.to (e) / pixels);
    }

    void mouseUp (const juce::MouseEvent& e) override
    {
        const bool moved = std::exchange (continues, false);
        if (std::exchange (holds_ring, false))
        {
            graph::Batch ended { NEEDS_TRANS ("end the modulation"), {} };
            for (const auto& d : depths)
                if (moved && d.modulation.depth == 0.0 && isTurned (d)) ended.commands.push_back (removeModulation (d.modulation));
            if (! ended.commands.empty()) document.perform (std::move (ended), graph::Step::joined);
            return;
        }
        if (! e.mods.isPopupMenu() && ! e.source.hasMovedSignificantlySincePressed() && ! field && ! has_no_effect) takeFocus (*this);   // to type a value
    }

    /// One turn of the wheel is one step of the history.
    void mouseWheelMove (const juce::MouseEvent& e, const juce::MouseWheelDetails& wheel) override
    {
        if (refusesHand()) return;
        const auto now = juce::Time::getMillisecondCounter();
        continues = now - turned_at < 500 && document.history().position() == turned_step;
        const auto version = document.version();
        turnTo (getValue() + static_cast<double> (wheel.deltaY) * (e.mods.isShiftDown() ? 0.02 : 0.2));
        continues = false;
        if (document.version() == version) return;   // at an end of the range
        turned_at = now;
        turned_step = document.history().position();
    }

    void focusGained (FocusChangeType cause) override
    {
        juce::Slider::focusGained (cause);
        repaint();
    }

    void focusLost (FocusChangeType cause) override
    {
        juce::Slider::focusLost (cause);
        repaint();
    }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        const auto& theme = look.theme();
        auto area = getLocalBounds().toFloat();
        const auto label = area.removeFromBottom (static_cast<float> (label_height));
        const auto dial = area.withSizeKeepingCentre (36.0f, 36.0f);
        const auto arc = [&] (double to, juce::Colour colour) {
            juce::Path p;
            const auto angle = [] (double half_turns) { return static_cast<float> (half_turns * juce::MathConstants<double>::pi); };
            p.addCentredArc (dial.getCentreX(), dial.getCentreY(), 16.0f, 16.0f, 0.0f, angle (scale_start), angle (to), true);
            g.setColour (colour);
            g.strokePath (p, juce::PathStrokeType (4.0f, juce::PathStrokeType::beveled, juce::PathStrokeType::rounded));
        };
        arc (scale_end, theme.hairline);
        if (getValue() > 0.0) arc (scale_start + (scale_end - scale_start) * getValue(), has_no_effect ? theme.dim.withMultipliedAlpha (0.5f) : theme.accent);
        for (const auto& d : depths)
            paintDepth (g, dial.getCentre(), ring_radius, 3.0f, getValue() + (d.modulation.is_one_sided ? 0.0 : -d.part), getValue() + d.part,
                        theme.of (Quantity::energy));
        if (hasKeyboardFocus (false))
        {
            g.setColour (theme.accent);
            g.drawRoundedRectangle (getLocalBounds().toFloat().reduced (0.5f), 4.0f, 1.0f);
        }
        g.setFont (look.font (11.0f));
        g.setColour (has_no_effect ? theme.dim : theme.text);
        g.drawText (juce::String (getValue(), 2), dial, juce::Justification::centred, false);
        g.setColour (isMouseOverOrDragging() ? theme.text : theme.dim);
        g.drawText (name, label, juce::Justification::centred, true);
    }

    void fillMenu (juce::PopupMenu& menu)
    {
        const auto item = [&] (const juce::String& text, void (Knob::*act)(), bool can = true) {
            menu.addItem (text, can, false, [safe = SafePointer (this), act] {
                if (safe != nullptr) (safe.getComponent()->*act)();
            });
        };
        menu.addSectionHeader (name);
        item (TRANS ("Type a value"), &Knob::typeValue, ! has_no_effect);
        item (TRANS ("Rename"), &Knob::rename);
        if (! strip.onModulate) return;
        menu.addSubMenu (TRANS ("Modulate by"), modulatorMenu (strip.catalogue, [safe = SafePointer (this)] (const std::string& type) {
                             if (safe != nullptr) safe->strip.onModulate (safe->id, type);
                         }));
    }

    void showMenu()
    {
        juce::PopupMenu menu;
        fillMenu (menu);
        menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (this));
    }

    void rename()
    {
        edit (TRANS ("Name of the control"), name, getLocalBounds().removeFromBottom (24),
              [this] (const juce::String& text) { edit ([to = text.trim().toStdString()] (graph::Control& c) { c.name = to; }, false); });
    }

    void typeValue()
    {
        edit (TRANS ("Value of the control"), juce::String (numberText (std::round (getValue() * 1e4) * 1e-4)), getLocalBounds().removeFromTop (24),
              [this] (const juce::String& text) {
                  const auto to = readControl (text.toStdString());
                  if (to)
                      change (*to, false);
                  else if (strip.onHint)
                      strip.onHint (messageText (to.error()));
              });
        field->selectAll();
    }

private:
    const graph::Control* find() const
    {
        const auto& all = document.graph().controls;
        const auto c = std::ranges::find (all, id, &graph::Control::id);
        return c == all.end() ? nullptr : &*c;
    }

    /// A value that wires set cannot be set by hand. Says so.
    bool refusesHand() const
    {
        if (has_no_effect && strip.onHint) strip.onHint (overridden);
        return has_no_effect;
    }

    /// Opens a field over a part of the knob.
    void edit (const juce::String& title, const juce::String& text, juce::Rectangle<int> place, std::function<void (const juce::String&)> apply)
    {
        if (field) field->apply();
        field = std::make_unique<TextField>();
        field->setTitle (title);
        field->show (text);
        field->onApply = std::move (apply);
        field->onFocusLost = [this] {
            field->apply();
            juce::MessageManager::callAsync ([safe = SafePointer (this)] {
                if (safe != nullptr && safe->field && ! safe->field->hasKeyboardFocus (true)) safe->field.reset();
            });
        };
        addAndMakeVisible (*field);
        field->setBounds (place);
        takeFocus (*field);
    }

    void turnTo (double value)
    {
        const double to = std::clamp (value, 0.0, 1.0);
        if (to == getValue()) return;
        change (to, continues);
        continues = true;
    }

    void change (double to, bool joins)
    {
        if (const auto* c = find(); c != nullptr && c->value != to) edit ([to] (graph::Control& changed) { changed.value = to; }, joins);
    }

    void edit (const std::function<void (graph::Control&)>& f, bool joins)
    {
        const auto* c = find();
        if (c == nullptr) return;
        auto changed = *c;
        f (changed);
        document.perform (graph::ChangeControl { id, std::move (changed) }, joins ? graph::Step::joined : graph::Step::own);
    }

    /// A modulator of a target.
    struct Depth
    {
        Modulation modulation;
        double range = 1.0, part = 0.0;   ///< of the target, in SI; the depth as a part of the scale
        std::string path {};              ///< of the target
    };

    void findDepths (const graph::Control& c)
    {
        depths.clear();
        for (const auto& t : c.to)
            if (const auto param = controlOf (document.graph(), t.path); param && param->high != param->low)
                for (auto& m : modulationsAt (document.graph(), t.path, strip.catalogue))
                {
                    const double range = param->high - param->low, part = m.depth / range;
                    depths.push_back ({ std::move (m), range, part, t.path });
                }
    }

    bool isOnRing (juce::Point<float> at) const
    {
        const auto middle = getLocalBounds().withTrimmedBottom (label_height).toFloat().getCentre();
        return ! depths.empty() && ! has_no_effect && std::abs (at.getDistanceFrom (middle) - ring_radius) <= 3.5f;
    }

    /// True if a drag on the ring changes it: by the same source as the first one, all targets go by the same part of their ranges.
    bool isTurned (const Depth& d) const { return d.modulation.from == depths.front().modulation.from; }

    void turnDepth (double pixels)
    {
        if (depths.empty()) return;
        const auto& first = depths.front();
        const double to = draggedDepth (part_grabbed, 1.0, pixels);
        if (to == first.part) return;
        graph::Batch turned { filled (NEEDS_TRANS ("change the depth of %1"), first.modulation.from).toStdString(), {} };
        for (const auto& d : depths)
            if (isTurned (d))
                if (auto command = changeDepth (document.graph(), d.modulation, to * d.range)) turned.commands.push_back (std::move (*command));
        if (turned.commands.empty() || ! document.perform (std::move (turned), continues ? graph::Step::joined : graph::Step::own) || depths.empty()) return;
        continues = true;
        if (! strip.onHint) return;
        const auto& now = depths.front();
        strip.onHint (now.modulation.depth == 0.0 ? filled (TRANS ("%1: release to end the modulation"), now.modulation.from)
                                                  : textOf (now.modulation));
    }

    static constexpr float ring_radius = 21.0f;

    KnobStrip& strip;
    Document& document;
    std::string id;
    std::vector<Depth> depths;
    double part_grabbed = 0.0;
    bool holds_ring = false;
    juce::String name, overridden;
    bool has_no_effect = false;         // wires set all its targets
    std::unique_ptr<TextField> field;   // while its name or its value is being typed
    DragWay way;
    double grabbed = 0.0;
    std::uint32_t turned_at = 0;   // by the wheel, in ms
    std::size_t turned_step = 0;
    bool continues = false;
};

KnobStrip::KnobStrip (Document& d, const Catalogue& c) : document (d), catalogue (c) { setTitle (TRANS ("Controls")); }

KnobStrip::~KnobStrip() = default;

void KnobStrip::rename (const std::string& id)
{
    const auto found = std::ranges::find (knobs, id, [] (const auto& k) { return k->control(); });
    if (found != knobs.end()) (*found)->rename();
}

juce::Slider& KnobStrip::knob (std::size_t i) { return *knobs[i]; }
void KnobStrip::fillMenu (juce::PopupMenu& menu, std::size_t i) { knobs[i]->fillMenu (menu); }

void KnobStrip::refresh()
{
    const auto& controls = document.graph().controls;
    if (! std::ranges::equal (controls, knobs, {}, &graph::Control::id, [] (const auto& k) { return k->control(); }))
    {
        knobs.clear();
        for (const auto& c : controls)
            addAndMakeVisible (*knobs.emplace_back (std::make_unique<Knob> (*this, c.id)));
        resized();
    }
    for (auto& k : knobs)
        k->refresh();
}

int KnobStrip::columnsFor (int width) const { return std::max (1, (width - 2 * strip_margin) / knob_width); }

int KnobStrip::heightFor (int width) const
{
    if (knobs.empty()) return 0;
    const int columns = columnsFor (width), rows = (static_cast<int> (knobs.size()) + columns - 1) / columns;
    return rows * knob_height + strip_margin;
}

void KnobStrip::paint (juce::Graphics& g)
{
    g.setColour (themeOf (*this).hairline);
    g.drawHorizontalLine (0, 0.0f, static_cast<float> (getWidth()));
}

void KnobStrip::resized()
{
    const int columns = columnsFor (getWidth()), each = (getWidth() - 2 * strip_margin) / columns;
    for (std::size_t i = 0; i < knobs.size(); ++i)
    {
        const int n = static_cast<int> (i);
        knobs[i]->setBounds (strip_margin + n % columns * each, strip_margin / 2 + n / columns * knob_height, each, knob_height);
    }
}

}   // namespace tactus::host
