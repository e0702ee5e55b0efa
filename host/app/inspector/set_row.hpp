// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "block.hpp"

namespace tactus::host
{

/// A label, and at its right what sets it. What was set is bold, and has an arrow that brings the default back, seen while the
/// pointer is over the row.
class SetRow : public Block, public juce::SettableTooltipClient
{
public:
    static constexpr int row_height = 28;

    explicit SetRow (juce::String label);

    int heightFor (int) override { return row_height; }

    std::function<void()> onReset;                        ///< none: there is no default to go back to
    std::function<void (juce::PopupMenu&)> onWantsMenu;   ///< fills the menu of the right button

    bool isSet() const noexcept { return is_set; }
    const juce::String& label() const noexcept { return words; }
    void setLabel (const juce::String&);

    void paint (juce::Graphics&) override;
    void resized() final;

protected:
    void setIsSet (bool);
    void setNote (const juce::String&, juce::Colour);   ///< a few small words over the label's end
    virtual void place (juce::Rectangle<int>) = 0;      ///< the fields go there

    bool stacked = false;   ///< the label stands over the fields, not beside them

private:
    class Arrow;
    class Watch;

    void hover();
    void openMenu();
    int labelWidth() const { return stacked ? getWidth() : getWidth() * 2 / 5; }

    juce::String words, note;
    juce::Colour note_colour;
    std::unique_ptr<Arrow> arrow;
    std::unique_ptr<Watch> watch;
    bool is_set = false;

public:
    ~SetRow() override;
};

}   // namespace tactus::host
