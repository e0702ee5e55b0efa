// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/drag_number.hpp>

#include <host/app/look/look.hpp>

#include <functional>
#include <memory>
#include <optional>

namespace tactus::host
{

/// A number that is dragged up and down, finely with shift, or typed after a double click or return, with a unit if one
/// likes. Alt-click brings the default back; the arrows go in small steps. It is amber outside its usual range, which the
/// bar under it stands for, and refuses what lies outside the hard one.
class NumberField final : public juce::Component, public juce::SettableTooltipClient
{
public:
    explicit NumberField (const PortSheet&);

    /// What it is, in a word, before the number where both fit.
    void setCaption (const juce::String& text) { caption = text; }

    void show (const Json& value);   ///< as the file has it
    const QuantityText& shown() const noexcept { return value; }

    /// A value, and whether it goes on with the one before, in one drag. Nothing for the default.
    std::function<void (std::optional<Json>, bool goes_on)> onChange;
    std::function<void (const juce::String&)> onRefused;

    void setStrong (bool);             ///< what is set, rather than left as it was
    void type (const juce::String&);   ///< as if it had been typed
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

    const PortSheet& sheet;
    juce::String caption;
    QuantityText value, grabbed;
    bool begun = false, strong = false;
    std::unique_ptr<juce::TextEditor> editor;
};

/// What a tooltip says of a number: its sentence, and between which ends it may be and usually is.
juce::String tooltipOf (const PortSheet&);

}   // namespace tactus::host
