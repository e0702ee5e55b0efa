// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "block.hpp"

namespace tactus::host
{

/// A label with fields to its right. The label of a value that is set is bold; on hover, an arrow resets it to the default.
class SetRow : public Block, public juce::SettableTooltipClient
{
public:
    static constexpr int row_height = 28;

    explicit SetRow (juce::String label);

    int heightFor (int) override { return row_height; }

    std::function<void()> onReset;                        ///< called to reset the value to its default; null if there is none
    std::function<void (juce::PopupMenu&)> onWantsMenu;   ///< fills the context menu

    bool isSet() const noexcept { return is_set; }
    const juce::String& label() const noexcept { return label_text; }

    void paint (juce::Graphics&) override;
    void resized() final;
    void childrenChanged() override;   // names the fields for screen readers

protected:
    void setIsSet (bool);
    void setNote (const juce::String&, juce::Colour);   ///< small text below the label
    virtual void place (juce::Rectangle<int>) = 0;      ///< lays out the fields

    bool stacked = false;   ///< puts the label above the fields

private:
    class Arrow;
    class Watch;

    void hover();
    void openMenu();
    int labelWidth() const { return stacked ? getWidth() : getWidth() * 2 / 5; }

    juce::String label_text, note;
    juce::Colour note_colour;
    std::unique_ptr<Arrow> arrow;
    std::unique_ptr<Watch> watch;
    bool is_set = false;

public:
    ~SetRow() override;
};

}   // namespace tactus::host
