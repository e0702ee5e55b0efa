// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/label_button.hpp>
#include <host/app/run/playback.hpp>
#include <host/app/scene/overlay.hpp>
#include <host/app/scene/scene.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

/// The scene in space: what the nodes of the graph look like, the tools, and the forces on them. Dragging turns the camera; with Shift
/// or the right button it moves; the wheel zooms about the pointer. Dragging the tool itself presses with it. Where devices can reach is a thin box,
/// with handles that move it. [main thread]
class SceneView final : public juce::Component
{
public:
    explicit SceneView (Playback&);

    void refresh();   ///< call many times a second while it is visible

    /// Starts or stops asking the run for values. A hidden view costs the run nothing.
    void watch (bool);

    void frameAll();             ///< shows the whole scene, from the current direction
    void lookAlong (int axis);   ///< looks along x, y or z; the second time from the other side
    void follow (bool);          ///< keeps the tool of the hand in the middle
    bool follows() const noexcept { return follow_button.getToggleState(); }
    void showReach (bool);   ///< where the devices can reach, if there are any; on at first
    bool showsReach() const noexcept { return reach_button.getToggleState(); }

    const scene::Camera& camera() const noexcept { return seen_by; }
    const scene::Raster::Count& triangles() const noexcept { return raster.count(); }   ///< of the last picture
    double pictureTime() const noexcept { return took_s; }                              ///< what the last picture took to draw, in s

    /// Called while the tool is dragged: where to, in m, and whether it presses.
    std::function<void (double x, double y, bool presses)> onSteer;
    std::function<void (double octaves)> onDeeper;   ///< the wheel while the tool is dragged

    std::function<std::vector<scene::Reach>()> reachesNow;   ///< where devices can reach; asked at each refresh
    const std::vector<scene::Reach>& reaches() const noexcept { return shown_reaches; }

    /// Called when the user has dragged a box: where the origin of the role's device shall be, in m.
    std::function<void (const std::string& role, const Vec3& origin)> onMoveOrigin;

    void paint (juce::Graphics&) override;
    void resized() override;
    void mouseMove (const juce::MouseEvent&) override;
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;
    void mouseDoubleClick (const juce::MouseEvent&) override;
    void mouseWheelMove (const juce::MouseEvent&, const juce::MouseWheelDetails&) override;
    void mouseMagnify (const juce::MouseEvent&, float factor) override;
    bool keyPressed (const juce::KeyPress&) override;
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override;

private:
    void drawSurfaces (float pixels_per_unit);
    void press (juce::Point<float>);
    void release();
    const scene::Tool* handTool() const { return now.tool (playback.current().handRole()); }   ///< the tool that a drag moves; null: none
    bool isOnTool (juce::Point<float>) const;
    bool refreshReaches();
    bool grabHandle (juce::Point<float>);
    void dropHandle();
    void drawReaches (scene::Overlay&) const;
    const scene::Reach* grabbedReach() const;
    void describe();
    void changed();

    static constexpr double slow_s = 0.02;   ///< a picture that takes longer is drawn with fewer samples while it moves

    Playback& playback;
    scene::Camera seen_by;
    scene::Scene stage;
    scene::SceneState now;
    scene::Raster raster;
    juce::Image surfaces;
    LabelButton follow_button { TRANS ("Follow"), TRANS ("Keeps the tool in the middle (T)") },
        frame_button { TRANS ("Frame"), TRANS ("Shows the whole scene (F, or double-click)") },
        reach_button { TRANS ("Reach"), TRANS ("Shows where the devices can reach. Drag an arrow to move the reach in the graph; the force fades meanwhile") };
    std::vector<scene::Reach> shown_reaches;
    std::uint64_t shown_version = 0;
    bool is_watched = false, is_dirty = true, is_framed = false, is_slow = false, is_coarse = false;
    int still_for = 0;   // calls to refresh() since something changed
    double took_s = 0.0, painted_ms = 0.0;

    enum class Drag
    {
        none,
        turn,
        move,
        tool,
        reach
    };
    Drag drag = Drag::none;
    juce::Point<float> dragged_to;
    juce::Point<float> grabbed_at;    // from where the tool was grabbed to its position, in pixels
    Vec3 steered_to = Vec3::Zero();   // where the dragged tool was moved last; z does not matter

    /// The handle that is dragged.
    struct Grabbed
    {
        std::string role;
        scene::Overlay::Dragged by {};
    };
    std::optional<Grabbed> grabbed;
};

}   // namespace tactus::host
