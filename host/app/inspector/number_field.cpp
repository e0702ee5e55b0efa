// SPDX-License-Identifier: GPL-3.0-or-later
#include "number_field.hpp"

#include <host/app/look/focus.hpp>

#include <framework/number_text.hpp>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr double fine = 0.1;

/// 500000 rather than 5e+05, as long as that is short.
std::string plainText (double v)
{
    if (v == 0.0 || ! (std::abs (v) >= 1e-4 && std::abs (v) < 1e7)) return numberText (v);
    char text[40];
    std::snprintf (text, sizeof text, "%.10g", v);
    return text;
}
}   // namespace

NumberField::NumberField (const PortSheet& s) : sheet (s)
{
    setMouseCursor (juce::MouseCursor::UpDownResizeCursor);
    setWantsKeyboardFocus (true);
    setMouseClickGrabsKeyboardFocus (false);   // a drag leaves the keys to the canvas
    setTooltip (tooltipOf (sheet));
}

void NumberField::setStrong (bool is_set)
{
    if (strong == is_set) return;
    strong = is_set;
    repaint();
}

void NumberField::show (const Json& written)
{
    const auto read = readQuantity (written, sheet);
    if (const auto* text = std::get_if<QuantityText> (&read)) value = *text;
    repaint();
}

void NumberField::mouseDown (const juce::MouseEvent& e)
{
    if (e.mods.isAltDown())
    {
        if (onChange) onChange (std::nullopt, false);
        return;
    }
    grabbed = value;
    begun = false;
}

void NumberField::mouseDrag (const juce::MouseEvent& e)
{
    if (e.mods.isAltDown() || e.mods.isPopupMenu() || isEditing()) return;
    const double pixels = -static_cast<double> (e.getDistanceFromDragStartY()) * (e.mods.isShiftDown() ? fine : 1.0);
    moveTo (dragged (grabbed, sheet, pixels));
}

void NumberField::moveTo (const QuantityText& to)
{
    if (to.number == value.number || ! sheet.limits.hard.contains (to.si())) return;
    value = to;
    repaint();
    const bool goes_on = std::exchange (begun, true);
    if (onChange) onChange (value.toJson(), goes_on);
}

void NumberField::mouseUp (const juce::MouseEvent&) { begun = false; }

void NumberField::mouseDoubleClick (const juce::MouseEvent& e)
{
    if (! e.mods.isAltDown()) openEditor();
}

bool NumberField::keyPressed (const juce::KeyPress& key)
{
    constexpr double step = 4.0;   // pixels of a drag
    const double way = key.isKeyCode (juce::KeyPress::upKey) ? step : key.isKeyCode (juce::KeyPress::downKey) ? -step
                                                                                                              : 0.0;
    if (way != 0.0)
    {
        grabbed = value;
        begun = false;
        moveTo (dragged (grabbed, sheet, key.getModifiers().isShiftDown() ? way * fine : way));
        begun = false;
        return true;
    }
    const auto c = key.getTextCharacter();
    const bool digit = (c >= '0' && c <= '9') || c == '-' || c == '.';
    if (! key.isKeyCode (juce::KeyPress::returnKey) && ! digit) return false;
    openEditor();
    if (digit) editor->setText (juce::String::charToString (c));
    return true;
}

void NumberField::openEditor()
{
    editor = std::make_unique<juce::TextEditor>();
    editor->setFont (lookOf (*this).font (12.0f));
    editor->setJustification (juce::Justification::centredRight);
    editor->setText (value.toText(), false);
    editor->onReturnKey = [this]
    {
        apply();
        takeFocus (*this);
    };
    editor->onEscapeKey = [this]
    {
        closeEditor();
        takeFocus (*this);
    };
    editor->onFocusLost = [this]
    { apply(); };
    addAndMakeVisible (*editor);
    resized();
    takeFocus (*editor);
    editor->selectAll();
}

void NumberField::apply()
{
    if (! isEditing()) return;
    const auto text = editor->getText();
    closeEditor();
    if (text.trim().toStdString() != value.toText()) type (text);
}

void NumberField::closeEditor()
{
    // It goes later: an editor may not go while it calls.
    editor->setVisible (false);
    juce::MessageManager::callAsync ([safe = juce::Component::SafePointer (this)]
                                     {
        if (safe != nullptr && ! safe->isEditing()) safe->editor.reset(); });
}

void NumberField::type (const juce::String& text)
{
    const auto trimmed = text.trim().toStdString();
    char* rest = nullptr;
    const double plain = std::strtod (trimmed.c_str(), &rest);
    // What is typed without a unit is in the unit that is shown.
    auto wanted = ! trimmed.empty() && *rest == '\0' ? QuantityText { plain, value.unit, value.scale }.toJson() : Json (trimmed);
    const auto read = readQuantity (wanted, sheet);
    if (const auto* problem = std::get_if<std::string> (&read))
    {
        if (onRefused) onRefused (*problem);
        return;
    }
    value = std::get<QuantityText> (read);
    repaint();
    if (onChange) onChange (value.toJson(), false);
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
    g.setColour (hasKeyboardFocus (false) ? theme.accent : isMouseOverOrDragging() ? theme.dim
                                                                                   : theme.hairline);
    g.drawRoundedRectangle (area.reduced (0.5f), 4.0f, 1.0f);

    const auto& usual = sheet.limits.usual;
    const bool unusual = ! usual.contains (value.si());
    if (std::isfinite (usual.min) && std::isfinite (usual.max) && usual.max > usual.min)
    {
        const double part = isLogarithmic (sheet) ? std::log (std::max (value.si(), usual.min) / usual.min) / std::log (usual.max / usual.min) : (value.si() - usual.min) / (usual.max - usual.min);
        const auto bar = area.reduced (3.0f, 2.0f).removeFromBottom (2.0f);
        g.setColour (theme.hairline);
        g.fillRect (bar);
        g.setColour (unusual ? theme.warning : theme.accent);
        g.fillRect (bar.withWidth (bar.getWidth() * static_cast<float> (std::clamp (part, 0.0, 1.0))));
    }

    g.setFont (look.font (12.0f));
    auto text = area.reduced (std::min (8.0f, area.getWidth() * 0.08f), 0.0f);
    const auto unit = value.unit.empty() ? sheet.unit.kind == UnitRule::Kind::fixed && sheet.unit.unit.symbol != "1" ? juce::String (std::string (sheet.unit.unit.symbol)) : juce::String() : juce::String (value.unit);
    if (const float width = g.getCurrentFont().getStringWidthFloat (unit) + 5.0f; unit.isNotEmpty() && width < 0.55f * text.getWidth())
    {
        g.setColour (theme.dim);
        g.drawText (unit, text, juce::Justification::centredRight, false);
        text.removeFromRight (width);
    }
    g.setFont (look.font (12.0f, strong));
    g.setColour (unusual ? theme.warning : theme.text);
    // Too long for its field, it is shown with fewer digits; its tooltip and its editor have them all.
    auto number = plainText (value.number);
    for (int digits = 6; digits > 1 && g.getCurrentFont().getStringWidthFloat (number) > text.getWidth(); --digits)
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

juce::String tooltipOf (const PortSheet& sheet)
{
    const bool has_unit = sheet.unit.kind == UnitRule::Kind::fixed && sheet.unit.unit.symbol != "1";
    const auto unit = has_unit ? ' ' + std::string (sheet.unit.unit.symbol) : std::string();
    const auto range = [&] (const Interval& i)
    {
        if (std::isinf (i.min) && std::isinf (i.max)) return std::string();
        if (std::isinf (i.max)) return "at least " + numberText (i.min) + unit;
        if (std::isinf (i.min)) return "at most " + numberText (i.max) + unit;
        return numberText (i.min) + " to " + numberText (i.max) + unit;
    };
    auto text = std::string (sheet.about);
    if (! text.empty()) text[0] = static_cast<char> (std::toupper (static_cast<unsigned char> (text[0])));
    if (const auto hard = range (sheet.limits.hard); ! hard.empty()) text += "\nAllowed: " + hard;
    if (const auto usual = range (sheet.limits.usual); ! usual.empty() && ! (sheet.limits.usual == sheet.limits.hard)) text += "\nUsual: " + usual;
    if (sheet.limits.latch) text += "\nRead when contact begins, or on the hit.";
    return text;
}

}   // namespace tactus::host
