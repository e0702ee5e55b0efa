// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "field_error.hpp"

#include <host/app/model/drag_number.hpp>

#include <host/app/look/drag_way.hpp>
#include <host/app/look/look.hpp>

#include <functional>
#include <memory>
#include <optional>

namespace tactus::host
{

/// A number field. Drag to the right or up to raise it (shift: fine), double-click or press Return to type a value, with an optional unit.
/// Alt-click restores the default; arrow keys change it in small steps. The bar shows the position within the usual range.
/// Outside that range the field is amber. What is refused, such as a value outside the hard range, stays in the field in red, with the
/// reason next to it, until it is corrected or Esc brings back the value.
class NumberField final : public juce::Component, public juce::SettableTooltipClient
{
public:
    explicit NumberField (const PortSheet&);

    /// A caption before the number, shown if both fit.
    void setCaption (const juce::String& text) { caption = text; }

    void show (const Json& value);   ///< shows a value as stored in the file
    const QuantityText& shown() const noexcept { return value; }

    /// A wire from this output sets the value, which is known while the graph runs, in SI. The field is dimmed and refuses other values. "": none does.
    void setDriver (const std::string& output, std::optional<double> now = {});
    bool isDriven() const noexcept { return ! driver.empty(); }

    /// Called with the new value, or nothing for the default. `continues` is true during a drag, after its first change.
    std::function<void (std::optional<Json>, bool continues)> onChange;
    std::function<void (const juce::String&)> onRefused;

    /// Replaces the function that reads typed text. Its result is in the unit of the field.
    std::function<Result<double> (const std::string&)> read;

    void setBold (bool);               ///< marks a value that is not the default
    bool type (const juce::String&);   ///< applies typed text; false if it is refused
    void openEditor();
    bool isEditing() const noexcept { return editor != nullptr && editor->isVisible(); }

    /// The text that was typed and refused, and why. Empty if what the field shows is its value.
    const juce::String& refused() const noexcept { return refused_text; }
    const juce::String& whyRefused() const noexcept { return error.text(); }

    juce::String spokenValue() const;   ///< "100 µm", for screen readers
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override;
    juce::String getTooltip() override { return refused_text.isEmpty() ? SettableTooltipClient::getTooltip() : error.text(); }
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
    void visibilityChanged() override;
    void parentHierarchyChanged() override { visibilityChanged(); }

private:
    void moveTo (const QuantityText&);
    bool refusesHand();
    void apply (bool by_return);
    void refuse (const juce::String& text, const juce::String& why);
    void accept();
    void closeEditor();
    void paintText (juce::Graphics&, juce::Rectangle<float>, juce::Colour) const;

    const PortSheet& sheet;
    juce::String caption;
    QuantityText value, grabbed;
    DragWay way;
    std::string driver;
    std::optional<double> driven_now;
    bool begun = false, bold = false;
    std::unique_ptr<juce::TextEditor> editor;
    juce::String refused_text;
    FieldError error;
};

/// The unit symbol to show. Empty for a pure number and for a generic port.
juce::String unitText (const UnitRule&);

/// The name of a number for screen readers: its readable name; if this is a symbol, its id or description.
juce::String spokenName (const PortSheet&);

/// A tooltip for a number: description, allowed range and usual range.
juce::String tooltipOf (const PortSheet&);

}   // namespace tactus::host
