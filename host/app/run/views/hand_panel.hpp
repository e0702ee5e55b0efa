// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "film_button.hpp"
#include "hand_view.hpp"
#include "scene_view.hpp"

#include <host/app/text/filled.hpp>

namespace tactus::host
{

/// The hand: what moves the tool, which tool if there are several, the surface it moves on, and the transport of a gesture or recording.
class HandPanel final : public juce::Component, public juce::FileDragAndDropTarget
{
public:
    HandPanel (Playback&, Sound&);

    void refresh();   ///< call many times a second

    /// The choice of the user in the list of what moves the tool, whatever moves it now. It is meant for other graphs, too, unless it is their own
    /// device.
    const LiveRun::Hand& chosen() const noexcept { return chosen_hand; }

    /// The choices for what moves the tool, and for which tool it is: the name of each, and a function that chooses it.
    std::vector<std::pair<juce::String, std::function<void()>>> choices();

    /// From now on, the tool is moved by its own device. Returns a function that takes this back, and when it is called again, does it again; it does
    /// nothing if the user has since chosen another hand.
    std::function<void()> useDevice();

    HandView& view() noexcept { return surface; }
    SceneView& scene() noexcept { return space; }
    FilmButton& film() noexcept { return film_button; }

    /// Shows the scene in space instead of the surface from above. While enlarged, a wide panel shows both.
    void showScene (bool);
    bool showsScene() const noexcept { return is_scene; }
    /// A scene that is not on the screen asks the run for nothing, unless it is filmed. Say so while the window is minimised or the panel is folded.
    void setSeen (bool);
    std::function<void()> onSceneToggled;   ///< called when the user has switched

    /// An enlarged panel takes the place of the canvas. The caller has to lay it out again when onEnlarge is called.
    void enlarge (bool);
    bool isEnlarged() const noexcept { return is_large; }
    std::function<void()> onEnlarge;

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
    void showTools();
    void showTransport (const LiveRun&);
    juce::String noteFor (const LiveRun&) const;
    bool showsBoth() const noexcept { return is_large && getWidth() >= least_width_for_both; }
    void connectScene();
    void watchScene();
    int wantedWidth (const juce::ComboBox&) const;

    static constexpr int least_width_for_both = 760;

    Playback& playback;
    Sound& sound;
    HandView surface { playback };
    SceneView space { playback };
    LabelButton from_above { TRANS ("2D"), TRANS ("The surface from above") }, in_space { TRANS ("3D"), TRANS ("The scene in space") };
    LabelButton larger { TRANS ("Enlarge"), TRANS ("Shows the scene in place of the canvas") };
    FilmButton film_button { playback, space };
    bool is_scene = false, is_large = false, is_seen = true, is_watching = false;
    int film_width = 0;   // that the label of the button needed at the last layout
    juce::ComboBox source, tools;
    LiveRun::Hand chosen_hand;
    std::vector<std::string> tool_roles;   // those in the list of tools
    std::string shown_tool;                // the one that is selected in it
    int shown_source = 0;                  // id of the source that refresh() has last put into the list; 0: it puts it there again
    std::unique_ptr<juce::Button> play, listen;
    juce::Slider position, speed;
    std::shared_ptr<TransportPath> transport;   // as of the last refresh(); its run may have ended since then
    juce::String note;
};

}   // namespace tactus::host
