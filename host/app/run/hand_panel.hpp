// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hand_view.hpp"

namespace tactus::host
{

/// The hand: who moves the tool, the surface it moves on, and, where that is a gesture or a recording, how it is played.
class HandPanel final : public juce::Component, public juce::FileDragAndDropTarget
{
public:
    explicit HandPanel (Sound&);

    void show (Performance&);   ///< many times a second

    HandView& view() noexcept { return surface; }

    std::function<void (const juce::String&)> onHint;   ///< why something cannot be
    std::function<void (Performance::Hand)> onHand;     ///< another hand is wanted

    void paint (juce::Graphics&) override;
    void resized() override;
    bool isInterestedInFileDrag (const juce::StringArray&) override;
    void filesDropped (const juce::StringArray&, int, int) override;

private:
    class PlayButton;
    class SoundButton;

    void choose();

    Sound& sound;
    HandView surface;
    juce::ComboBox who;
    std::unique_ptr<juce::Button> play, listen;
    juce::Slider position, speed;
    std::shared_ptr<TransportPath> transport;   // of the last show(); its run may be over since
    juce::String note;
};

}   // namespace tactus::host
