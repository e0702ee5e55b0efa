// SPDX-License-Identifier: GPL-3.0-or-later
#include "number_field.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/readable.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/text/number_text.hpp>
#include <tactus/text/read_number.hpp>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <utility>

namespace tactus::host
{

namespace
{
/// The value of a field, as a screen reader says and sets it.
class FieldValue final : public juce::AccessibilityTextValueInterface
{
public:
    explicit FieldValue (NumberField& f) : field (f) {}

    bool isReadOnly() const override { return field.isDriven(); }
    juce::String getCurrentValueAsString() const override { return field.spokenValue(); }
    void setValueAsString (const juce::String& text) override { field.type (text); }

private:
    NumberField& field;
};

/// Writes numbers of moderate size without an exponent: 500000, not 5e+05.
std::string plainText (double v)
{
    constexpr int digits = 10;   // without the last bits that a computed value has
    if (v == 0.0 || ! (std::abs (v) >= 1e-4 && std::abs (v) < 1e7)) return numberText (rounded (v, digits));
    return roundedText (v, digits);
}

/// The position of a value within a range, 0…1.
double partOf (const Interval& range, double v, bool is_logarithmic)
{
    if (is_logarithmic) return std::log (std::max (v, range.min) / range.min) / std::log (range.max / range.min);
    return (v - range.min) / (range.max - range.min);
}
}   // namespace

NumberField::NumberField (const PortSheet& s) : sheet (s)
{
    setMouseCursor (juce::MouseCursor::UpDownLeftRightResizeCursor);
    setWantsKeyboardFocus (true);
    setMouseClickGrabsKeyboardFocus (false);   // the canvas keeps the keyboard focus during a drag
    setTooltip (tooltipOf (sheet));
    setTitle (spokenName (sheet));
}

juce::String NumberField::spokenValue() const
{
    if (isDriven() && ! driven_now) return fromUtf8 (driver);
    const auto unit = value.unit.empty() ? unitText (sheet.unit) : fromUtf8 (unitShown (value.unit));
    return juce::String (plainText (value.number)) + (unit.isEmpty() ? "" : " " + unit);
}

std::unique_ptr<juce::AccessibilityHandler> NumberField::createAccessibilityHandler()
{
    auto actions = juce::AccessibilityActions().addAction (juce::AccessibilityActionType::press, [this] {
        if (! refusesHand()) openEditor();
    });
    return std::make_unique<juce::AccessibilityHandler> (*this, juce::AccessibilityRole::slider, std::move (actions),
                                                         juce::AccessibilityHandler::Interfaces { std::make_unique<FieldValue> (*this) });
}

void NumberField::setBold (bool is_set)
{
    if (bold == is_set) return;
    bold = is_set;
    repaint();
}

void NumberField::setDriver (const std::string& output, std::optional<double> now)
{
    if (output == driver && now == driven_now) return;
    if (output != driver)
    {
        driver = output;
        setMouseCursor (isDriven() ? juce::MouseCursor::NormalCursor : juce::MouseCursor::UpDownLeftRightResizeCursor);
        if (isEditing()) closeEditor();
        accept();
    }
    driven_now = now;
    if (now) value = withBestPrefix ({ rounded (*now), {}, 1.0 }, sheet);
    repaint();
}

/// A value that a wire sets cannot be set by hand. Says so.
bool NumberField::refusesHand()
{
    if (isDriven() && onRefused) onRefused (drivenText (driver));
    return isDriven();
}

void NumberField::show (const Json& written)
{
    if (isDriven()) return;
    if (const auto now = readQuantity (written, sheet))
    {
        if (refused_text.isNotEmpty() && now->toText() != value.toText()) accept();   // changed from elsewhere, such as by an undo
        value = withBestPrefix (*now, sheet);
    }
    repaint();
}

void NumberField::mouseDown (const juce::MouseEvent& e)
{
    if (! e.mods.isPopupMenu() && refusesHand()) return;
    if (e.mods.isAltDown())
    {
        accept();
        if (onChange) onChange (std::nullopt, false);
        return;
    }
    grabbed = value;
    way = {};
    begun = false;
}

void NumberField::mouseDrag (const juce::MouseEvent& e)
{
    if (e.mods.isAltDown() || e.mods.isPopupMenu() || isEditing() || isDriven()) return;
    moveTo (dragged (grabbed, sheet, way.to (e)));
}

void NumberField::moveTo (const QuantityText& to)
{
    if (to.number == value.number || ! sheet.limits.hard.contains (to.si())) return;
    value = to;
    accept();
    const bool continues = std::exchange (begun, true);
    if (onChange) onChange (value.toJson(), continues);
}

/// A click, but not a drag, gives the field the keyboard, so that a value can be typed.
void NumberField::mouseUp (const juce::MouseEvent& e)
{
    begun = false;
    if (! e.mods.isAltDown() && ! e.mods.isPopupMenu() && ! e.source.hasMovedSignificantlySincePressed() && ! isEditing() && ! isDriven())
        takeFocus (*this);
}

void NumberField::mouseDoubleClick (const juce::MouseEvent& e)
{
    if (! e.mods.isAltDown() && ! isDriven()) openEditor();
}

bool NumberField::keyPressed (const juce::KeyPress& key)
{
    constexpr double step = 4.0, fine = 0.1;   // an arrow key acts like a drag by this many pixels; fine: with Shift
    if (isArrow (key) && ! key.getModifiers().isCtrlDown())
    {
        const bool is_up = key.isKeyCode (juce::KeyPress::upKey) || key.isKeyCode (juce::KeyPress::rightKey);
        if (refusesHand()) return true;
        const double pixels = (is_up ? step : -step) * (key.getModifiers().isShiftDown() ? fine : 1.0);
        grabbed = value;
        begun = false;
        moveTo (dragged (grabbed, sheet, pixels));
        begun = false;
        return true;
    }
    const bool digit = isTypedNumber (key);
    if (! key.isKeyCode (juce::KeyPress::returnKey) && ! digit && ! isErasing (key)) return false;
    if (refusesHand()) return true;
    openEditor();
    if (isErasing (key)) editor->clear();
    if (digit) editor->insertTextAtCaret (juce::String::charToString (key.getTextCharacter()));
    return true;
}

void NumberField::openEditor()
{
    editor = std::make_unique<juce::TextEditor>();
    editor->setFont (lookOf (*this).font (12.0f));
    editor->setJustification (juce::Justification::centredRight);
    editor->setIndents (4, 0);   // else, the text is too low in a field of this height
    editor->setText (refused_text.isEmpty() ? juce::String (value.toText()) : refused_text, false);
    editor->onReturnKey = [this] { apply (true); };
    editor->onEscapeKey = [this] {
        accept();
        letGoOfFocus (*editor);   // the canvas gets the keyboard
        closeEditor();
    };
    editor->onFocusLost = [this] { apply (false); };
    addAndMakeVisible (*editor);
    resized();
    takeFocus (*editor);
    editor->selectAll();
}

void NumberField::apply (bool by_return)
{
    if (! isEditing()) return;
    const auto text = editor->getText();
    const bool is_same = text.trim().toStdString() == value.toText() || text.trim() == spokenValue();   // what is shown may be rounded
    const bool is_accepted = is_same || type (text);
    if (is_accepted) accept();
    if (by_return && ! is_accepted) return;   // stays open, for another try
    error.fold();                             // from now on, the tooltip shows it
    closeEditor();
    if (by_return) takeFocus (*this);
}

void NumberField::refuse (const juce::String& text, const juce::String& why)
{
    refused_text = text;
    error.show (*this, why);
    if (isEditing())
        for (const auto id : { juce::TextEditor::outlineColourId, juce::TextEditor::focusedOutlineColourId })
            editor->setColour (id, themeOf (*this).stop);
    if (onRefused) onRefused (why);
    repaint();
}

void NumberField::accept()
{
    refused_text.clear();
    error.hide();
    repaint();
}

void NumberField::visibilityChanged()
{
    if (refused_text.isNotEmpty() && ! isShowing()) accept();
}

void NumberField::closeEditor()
{
    // Deleted later: this may be called from the editor itself.
    editor->setVisible (false);
    juce::MessageManager::callAsync ([safe = juce::Component::SafePointer (this)] {
        if (safe != nullptr && ! safe->isEditing()) safe->editor.reset();
    });
}

bool NumberField::type (const juce::String& text)
{
    if (refusesHand()) return false;
    const auto trimmed = text.trim().toStdString();
    const auto custom = read ? read (trimmed) : Result<double> (0.0);
    if (! custom)
    {
        refuse (text, messageText (custom.error()));
        return false;
    }
    const auto taken = read ? readQuantity (*custom, sheet) : readTyped (trimmed, value, sheet);
    if (! taken)
    {
        refuse (text, fromUtf8 (taken.error().text));
        return false;
    }
    value = *taken;
    accept();
    if (onChange) onChange (value.toJson(), false);
    return true;
}

void NumberField::resized()
{
    if (editor) editor->setBounds (getLocalBounds());
}

void NumberField::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    auto area = getLocalBounds().toFloat();
    g.setColour (theme.raised);
    g.fillRoundedRectangle (area, 4.0f);
    const auto outline = isMouseOverOrDragging() ? theme.dim : theme.hairline;
    g.setColour (hasKeyboardFocus (false) ? theme.accent : outline);
    if (refused_text.isNotEmpty()) g.setColour (theme.stop);
    g.drawRoundedRectangle (area.reduced (0.5f), 4.0f, 1.0f);
    if (refused_text.isNotEmpty())
    {
        g.setFont (look.font (12.0f, bold));
        return g.drawText (refused_text, area.reduced (8.0f, 0.0f), juce::Justification::centredRight, true);
    }

    const auto text_area = area.reduced (std::min (8.0f, area.getWidth() * 0.08f), 0.0f);
    if (isDriven() && ! driven_now)   // what it is will be known when the graph runs
    {
        g.setFont (look.font (12.0f));
        g.setColour (theme.dim);
        return g.drawText (fromUtf8 (driver), text_area, juce::Justification::centredRight, true);
    }
    const auto& usual = sheet.limits.usual;
    const bool unusual = ! usual.contains (value.si());
    const auto lit = isDriven() ? theme.dim : theme.accent;
    if (std::isfinite (usual.min) && std::isfinite (usual.max) && usual.max > usual.min)
    {
        const auto bar = area.reduced (3.0f, 2.0f).removeFromBottom (2.0f);
        g.setColour (theme.hairline);
        g.fillRect (bar);
        g.setColour (unusual ? theme.warning : lit);
        g.fillRect (bar.withWidth (bar.getWidth() * static_cast<float> (std::clamp (partOf (usual, value.si(), isLogarithmic (sheet)), 0.0, 1.0))));
    }
    const auto usual_colour = isDriven() ? theme.dim : theme.text;
    paintText (g, text_area, unusual ? theme.warning : usual_colour);
}

void NumberField::paintText (juce::Graphics& g, juce::Rectangle<float> text, juce::Colour colour) const
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.setFont (look.font (12.0f));
    const auto unit = value.unit.empty() ? unitText (sheet.unit) : fromUtf8 (unitShown (value.unit));
    if (const float width = g.getCurrentFont().getStringWidthFloat (unit) + 5.0f; unit.isNotEmpty() && width < 0.55f * text.getWidth())
    {
        g.setColour (theme.dim);
        g.drawText (unit, text, juce::Justification::centredRight, false);
        text.removeFromRight (width);
    }
    g.setFont (look.font (12.0f, bold));
    g.setColour (colour);
    // A number that is too long is shown with fewer digits, but without an exponent: -120, not -1e+02. The editor shows them all.
    auto number = plainText (value.number);
    const int least = 1 + static_cast<int> (std::clamp (std::log10 (std::max (1.0, std::abs (value.number))), 1.0, 5.0));
    for (int digits = 6; digits >= least && g.getCurrentFont().getStringWidthFloat (number) > text.getWidth(); --digits)
    {
        char shorter[40];
        std::snprintf (shorter, sizeof shorter, "%.*g", digits, value.number);
        number = shorter;
    }
    const float number_width = g.getCurrentFont().getStringWidthFloat (number);
    drawNumber (g, number, text);
    const auto small = look.font (11.0f);
    if (caption.isEmpty() || small.getStringWidthFloat (caption) + 4.0f + number_width > text.getWidth()) return;
    g.setFont (small);
    g.setColour (theme.dim);
    g.drawText (caption, text, juce::Justification::centredLeft, false);
}

juce::String unitText (const UnitRule& rule)
{
    const bool has_unit = rule.kind == UnitRule::Kind::fixed && rule.unit.symbol != "1";
    return has_unit ? fromUtf8 (unitShown (std::string (rule.unit.symbol))) : juce::String();
}

juce::String spokenName (const PortSheet& sheet)
{
    const auto name = fromUtf8 (readable (sheet.id));
    if (name.length() > 1) return name;
    if (sheet.id.size() > 1) return fromUtf8 (sheet.id);
    return filled (TRANS ("Parameter %1"), name) + (sheet.about.empty() ? juce::String() : ", " + fromUtf8 (sheet.about));
}

juce::String tooltipOf (const PortSheet& sheet)
{
    const auto symbol = sheet.unit.kind == UnitRule::Kind::fixed ? sheet.unit.unit.symbol : std::string_view();
    const auto range = [&] (const Interval& i) {
        if (std::isinf (i.min) && std::isinf (i.max)) return juce::String();
        if (std::isinf (i.max)) return filled (TRANS ("at least %1"), shownQuantity (i.min, symbol));
        if (std::isinf (i.min)) return filled (TRANS ("at most %1"), shownQuantity (i.max, symbol));
        return filled (TRANS ("%1 to %2"), shownQuantity (i.min, symbol), shownQuantity (i.max, symbol));
    };
    auto text = fromUtf8 (sheet.about);
    text = text.substring (0, 1).toUpperCase() + text.substring (1);
    if (const auto hard = range (sheet.limits.hard); hard.isNotEmpty()) text << "\n" + filled (TRANS ("Allowed: %1"), hard);
    if (const auto usual = range (sheet.limits.usual); usual.isNotEmpty() && ! (sheet.limits.usual == sheet.limits.hard))
        text << "\n" + filled (TRANS ("Usual: %1"), usual);
    if (sheet.limits.latch) text << "\n" + TRANS ("The value is sampled when contact begins, or on a hit.");
    return text;
}

}   // namespace tactus::host
