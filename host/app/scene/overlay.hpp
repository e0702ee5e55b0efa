// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "reach.hpp"
#include "scene.hpp"

#include <host/app/look/look.hpp>

namespace tactus::host::scene
{

/// The marks that a picture draws over the surfaces: forces with their numbers, stretched contacts, cracks, heights, the axes and the scale.
class Overlay
{
public:
    Overlay (juce::Graphics& g, const Look& l, const Camera& c, juce::Rectangle<float> a) : graphics (g), look (l), camera (c), area (a) {}

    void drawGround (const Scene&);   ///< lines below everything, for a scene without a plane; call it before the surfaces are drawn
    void drawMarks (const Scene&, const SceneState&);
    void drawScale (const Scene&, const SceneState&);
    void drawAxes();

    /// The edges of the box that a device can reach, and a handle along each axis to move it. A handle that is dragged is lit, with how far it has gone.
    struct Dragged
    {
        int axis = 0;
        double metres = 0.0;
    };
    void drawReach (const Reach&, bool names_role, std::optional<Dragged>);

    /// The handle for an axis: from near the middle of the box outwards. Empty if the middle is not in the picture, or the axis points at the eye.
    static std::optional<juce::Line<float>> handle (const Camera&, juce::Rectangle<float> area, const Reach&, int axis);

    /// The axis whose handle is at this place.
    static std::optional<int> handleAt (const Camera&, juce::Rectangle<float> area, const Reach&, juce::Point<float>);

    /// The distance in m by which the middle of a box goes along an axis when its handle is dragged by this many pixels.
    static double dragged (const Camera&, const Reach&, int axis, juce::Point<float> pixels);

    /// The axis of the gizmo at this place: 0, 1 or 2 for x, y or z; empty: none.
    static std::optional<int> axisAt (const Camera&, juce::Rectangle<float> area, juce::Point<float>);

    /// The length of the arrow of a force on the screen, in pixels, if it lies in the picture: 48 pixels per newton, up to a limit.
    static double arrowLength (double newtons, double height) noexcept;

    /// The line from a hovering tool to the plane below it, as far as the area shows it; empty: none to draw.
    static std::optional<juce::Line<float>> plumb (const Camera&, juce::Rectangle<float> area, const Tool&, const Body& plane);

    static juce::String forceText (double newtons);

private:
    static juce::Point<float> gizmoCentre (juce::Rectangle<float> area) { return area.getTopRight() + juce::Point<float> (-34.0f, 36.0f); }
    static juce::Point<float> gizmoEnd (const Camera&, juce::Rectangle<float> area, int axis);

    void drawForce (const Tool&, bool names_role);
    void drawPlumb (const Tool&, const Scene&, const std::vector<Touch>&);
    void drawRing (const StuckBound&);
    bool isInFront (const Vec3&) const;
    static juce::Point<float> pixelsPerMetre (const Camera&, const Reach&, int axis);
    enum class Side
    {
        left,
        right
    };
    void label (const juce::String&, juce::Point<float>, Side, juce::Colour);   ///< on this side of the point, above earlier labels
    void backdrop (juce::Rectangle<float>) const;

    juce::Graphics& graphics;
    const Look& look;
    const Camera& camera;
    juce::Rectangle<float> area;
    std::vector<juce::Rectangle<float>> labels;   // drawn so far
};

}   // namespace tactus::host::scene
