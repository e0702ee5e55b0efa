// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hand_view.hpp"

namespace tactus::host
{

/// The hand: what moves the tool, the surface it moves on, and the transport of a gesture or recording.
class HandPanel final : public juce::Component, public juce::FileDragAndDropTarget
{
public:
    HandPanel (Playback&, Sound&);

    void refresh();   ///< call many times a second

    HandView& view() noexcept { return surface; }

    std::function<void (const juce::String&)> onHint;   ///< receives the reason why something is not possible

    void paint (juce::Graphics&) override;
    void resized() override;
    bool isInterestedInFileDrag (const juce::StringArray&) override;
    void filesDropped (const juce::StringArray&, int, int) override;

private:
    class PlayButton;
    class SoundButton;

    void choose();
    void showSource (const LiveRun::Hand&);
    void showTransport (const LiveRun&);
    juce::String noteFor (const LiveRun&) const;

    Playback& playback;
    Sound& sound;
    HandView surface { playback };
    juce::ComboBox source;
    std::unique_ptr<juce::Button> play, listen;
    juce::Slider position, speed;
    std::shared_ptr<TransportPath> transport;   // as of the last refresh(); its run may have ended since then
    juce::String note;
};

}   // namespace tactus::host
