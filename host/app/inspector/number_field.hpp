// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/drag_number.hpp>

#include <host/app/look/look.hpp>

#include <functional>
#include <memory>
#include <optional>

namespace tactus::host
{

/// A number field. Drag up or down to change it (shift: fine), double-click or press Return to type a value, with an optional unit.
/// Alt-click restores the default; arrow keys change it in small steps. The bar shows the position within the usual range.
/// Outside that range the field is amber; values outside the hard range are refused.
class NumberField final : public juce::Component, public juce::SettableTooltipClient
{
public:
    explicit NumberField (const PortSheet&);

    /// A caption before the number, shown if both fit.
    void setCaption (const juce::String& text) { caption = text; }

    void show (const Json& value);   ///< shows a value as stored in the file
    const QuantityText& shown() const noexcept { return value; }

    /// Called with the new value, or nothing for the default. `continues` is true during a drag, after its first change.
    std::function<void (std::optional<Json>, bool continues)> onChange;
    std::function<void (const juce::String&)> onRefused;

    void setBold (bool);               ///< marks a value that is not the default
    void type (const juce::String&);   ///< applies typed text
    void openEditor();
    bool isEditing() const noexcept { return editor != nullptr && editor->isVisible(); }

    void paint (juce::Graphics&) override;
    void resized() override;
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;
    void mouseDoubleClick (const juce::MouseEvent&) override;
    void mouseEnter (const juce::MouseEvent&) override { repaint(); }
    void mouseExit (const juce::MouseEvent&) override { repaint(); }
    void focusGained (FocusChangeType) override { repaint(); }
    void focusLost (FocusChangeType) override { repaint(); }
    bool keyPressed (const juce::KeyPress&) override;

private:
    void moveTo (const QuantityText&);
    void apply();
    void closeEditor();
    void paintText (juce::Graphics&, juce::Rectangle<float>, juce::Colour) const;

    const PortSheet& sheet;
    juce::String caption;
    QuantityText value, grabbed;
    bool begun = false, bold = false;
    std::unique_ptr<juce::TextEditor> editor;
};

/// The unit symbol to show. Empty for a pure number and for a generic port.
juce::String unitText (const UnitRule&);

/// A tooltip for a number: description, allowed range and usual range.
juce::String tooltipOf (const PortSheet&);

}   // namespace tactus::host
