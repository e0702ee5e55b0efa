// SPDX-License-Identifier: GPL-3.0-or-later
#include "number_field.hpp"

#include <framework/number_text.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
constexpr double pixels_over_range = 200.0, fine = 0.1;
}

NumberField::NumberField (const PortSheet& s) : sheet (s) { setMouseCursor (juce::MouseCursor::UpDownResizeCursor); }

void NumberField::show (const Json& written)
{
    const auto read = readQuantity (written, sheet);
    if (const auto* text = std::get_if<QuantityText> (&read)) value = *text;
    repaint();
}

bool NumberField::isLogarithmic() const noexcept
{
    const auto& usual = sheet.limits.usual;
    return usual.min > 0.0 && std::isfinite (usual.max) && usual.max / usual.min >= 100.0;
}

double NumberField::moved (double pixels) const
{
    const auto& usual = sheet.limits.usual;
    const double from = grabbed.si(), part = pixels / pixels_over_range;
    double to = from;
    if (isLogarithmic() && from > 0.0)
        to = from * std::pow (usual.max / usual.min, part);
    else if (std::isfinite (usual.min) && std::isfinite (usual.max))
        to = from + (usual.max - usual.min) * part;
    else
        to = from + std::max (std::abs (from), grabbed.scale) * 2.0 * part;
    return sheet.limits.hard.clamp (to);
}

void NumberField::mouseDown (const juce::MouseEvent& e)
{
    if (e.mods.isAltDown())
    {
        if (onChange) onChange (std::nullopt, false);
        return;
    }
    grabbed = value;
    dragged = false;
}

void NumberField::mouseDrag (const juce::MouseEvent& e)
{
    if (e.mods.isAltDown() || editor) return;
    const double pixels = -static_cast<double> (e.getDistanceFromDragStartY()) * (e.mods.isShiftDown() ? fine : 1.0);
    const auto to = grabbed.moved (moved (pixels));
    if (to.number == value.number || ! sheet.limits.hard.contains (to.si())) return;
    value = to;
    repaint();
    if (onChange) onChange (value.toJson(), dragged);
    dragged = true;
}

void NumberField::mouseUp (const juce::MouseEvent&) { dragged = false; }

void NumberField::mouseDoubleClick (const juce::MouseEvent&)
{
    editor = std::make_unique<juce::TextEditor>();
    editor->setFont (lookOf (*this).font (12.0f));
    editor->setJustification (juce::Justification::centredRight);
    editor->setText (value.toText(), false);
    editor->onReturnKey = [this]
    {
        const auto text = editor->getText();
        closeEditor();
        type (text);
    };
    editor->onEscapeKey = [this]
    { closeEditor(); };
    editor->onFocusLost = [this]
    { closeEditor(); };
    addAndMakeVisible (*editor);
    resized();
    editor->grabKeyboardFocus();
    editor->selectAll();
}

void NumberField::closeEditor()
{
    // Not at once: an editor may not go while it calls.
    juce::MessageManager::callAsync ([safe = juce::Component::SafePointer (this)]
                                     {
        if (safe != nullptr) safe->editor.reset(); });
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
    g.setColour (isMouseOverOrDragging() ? theme.dim : theme.hairline);
    g.drawRoundedRectangle (area.reduced (0.5f), 4.0f, 1.0f);

    const auto& usual = sheet.limits.usual;
    const bool unusual = ! usual.contains (value.si());
    if (std::isfinite (usual.min) && std::isfinite (usual.max) && usual.max > usual.min)
    {
        const double part = isLogarithmic() ? std::log (std::max (value.si(), usual.min) / usual.min) / std::log (usual.max / usual.min) : (value.si() - usual.min) / (usual.max - usual.min);
        g.setColour ((unusual ? theme.warning : theme.accent).withAlpha (0.25f));
        g.fillRoundedRectangle (area.reduced (1.0f).withWidth ((area.getWidth() - 2.0f) * static_cast<float> (std::clamp (part, 0.0, 1.0))), 3.0f);
    }

    g.setFont (look.font (12.0f));
    auto text = area.reduced (8.0f, 0.0f);
    const auto unit = value.unit.empty() ? sheet.unit.kind == UnitRule::Kind::fixed && sheet.unit.unit.symbol != "1" ? juce::String (std::string (sheet.unit.unit.symbol)) : juce::String() : juce::String (value.unit);
    if (unit.isNotEmpty())
    {
        g.setColour (theme.dim);
        g.drawText (unit, text, juce::Justification::centredRight, false);
        text.removeFromRight (g.getCurrentFont().getStringWidthFloat (unit) + 5.0f);
    }
    g.setColour (unusual ? theme.warning : theme.text);
    drawNumber (g, numberText (value.number), text);
}

}   // namespace tactus::host
