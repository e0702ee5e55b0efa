// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quantity_text.hpp"

#include <host/app/look/look.hpp>

#include <functional>
#include <memory>
#include <optional>

namespace tactus::host
{

/// A number that is dragged up and down, finely with shift, or typed after a double click, with a unit if one likes. Alt-click
/// brings the default back. It is amber outside its usual range, and refuses what lies outside the hard one.
class NumberField final : public juce::Component, public juce::SettableTooltipClient
{
public:
    explicit NumberField (const PortSheet&);

    void show (const Json& value);   ///< as the file has it
    const QuantityText& shown() const noexcept { return value; }

    /// A value, and whether it goes on with the one before, in one drag. Nothing for the default.
    std::function<void (std::optional<Json>, bool goes_on)> onChange;
    std::function<void (const juce::String&)> onRefused;

    void type (const juce::String&);   ///< as if it had been typed

    void paint (juce::Graphics&) override;
    void resized() override;
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;
    void mouseDoubleClick (const juce::MouseEvent&) override;

private:
    bool isLogarithmic() const noexcept;
    double moved (double by_pixels) const;
    void closeEditor();

    const PortSheet& sheet;
    QuantityText value, grabbed;
    bool dragged = false;
    std::unique_ptr<juce::TextEditor> editor;
};

}   // namespace tactus::host
