// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_view.hpp"

#include <host/app/look/focus.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr double radians_per_pixel = 0.008;
constexpr float key_step = 24.0f;   // pixels that an arrow key turns or moves
constexpr int rest_after = 6;       // calls to refresh() until a picture is at rest

bool isSame (const scene::SceneState& a, const scene::SceneState& b)
{
    const auto same = [] (const scene::Tool& s, const scene::Tool& t) { return s.role == t.role && s.position == t.position && s.force == t.force; };
    return std::ranges::equal (a.tools, b.tools, same) && a.live == b.live;
}
}   // namespace

SceneView::SceneView (Playback& p) : playback (p)
{
    setTitle (TRANS ("Scene"));
    setWantsKeyboardFocus (true);
    follow_button.setClickingTogglesState (true);
    follow_button.onClick = [this] { changed(); };
    frame_button.onClick = [this] { frameAll(); };
    reach_button.setClickingTogglesState (true);
    reach_button.setToggleState (true, juce::dontSendNotification);
    reach_button.onClick = [this] { changed(); };
    addAndMakeVisible (follow_button);
    addAndMakeVisible (frame_button);
    addChildComponent (reach_button);
}

void SceneView::watch (bool w)
{
    is_watched = w;
    if (w) return;
    release();
    for (auto* run : { &playback.run(), &playback.current() })   // the second is that of a preview, if there is one
    {
        run->scene().watch (false);
        run->film().watch (false);
    }
}

void SceneView::refresh()
{
    if (! is_watched) return;
    auto& feed = playback.current().scene();
    feed.watch (true);
    auto& film = playback.current().film();
    film.watch (true);
    if (shown_version != feed.version())
    {
        const auto differ = [] (const Vec3& a, const Vec3& b) { return (a - b).norm() > 1e-3; };
        const auto before = stage.bounds();
        shown_version = feed.version();
        stage.setBodies (feed.bodies());
        const auto after = stage.bounds();
        const bool is_same = before.isEmpty() == after.isEmpty() && (after.isEmpty() || ! (differ (before.low, after.low) || differ (before.high, after.high)));
        if (! is_same || ! is_framed) frameAll();
        is_dirty = true;
    }
    auto latest = feed.now();
    if (! playback.current().isRunning()) latest.tools.clear();   // the last ones would look as if they still pressed
    const bool is_news = ! isSame (latest, now);
    is_dirty = refreshReaches() || is_dirty;
    now = std::move (latest);
    if (const auto* tool = handTool(); follows() && tool != nullptr)
    {
        const Vec3 away = tool->position - seen_by.target;
        if (away.norm() > 2e-4)
        {
            seen_by.target += 0.25 * away;   // glides, so that a tremor does not shake the picture
            is_dirty = true;
        }
    }
    if (playback.current().isRunning()) film.add (stage, shown_version, now, seen_by);
    still_for = is_news || is_dirty ? 0 : still_for + 1;
    if (is_news) describe();
    is_dirty = is_dirty || is_news;
    const bool refines = still_for >= rest_after && is_coarse;   // at rest, the edges are smoothed
    const double since_s = 1e-3 * (juce::Time::getMillisecondCounterHiRes() - painted_ms);
    if (since_s < took_s || (! is_dirty && ! refines)) return;   // leaves half of the time to the rest of the window
    is_dirty = is_coarse = false;
    repaint();
}

/// True if the picture of where the devices can reach has changed.
bool SceneView::refreshReaches()
{
    auto latest = reachesNow ? reachesNow() : std::vector<scene::Reach> {};
    if (latest == shown_reaches) return false;
    shown_reaches = std::move (latest);
    reach_button.setVisible (! shown_reaches.empty());
    if (grabbed && grabbedReach() == nullptr) grabbed.reset();   // its device has another role now
    return true;
}

const scene::Reach* SceneView::grabbedReach() const
{
    const auto at = grabbed ? std::ranges::find (shown_reaches, grabbed->role, &scene::Reach::role) : shown_reaches.end();
    return at != shown_reaches.end() ? &*at : nullptr;
}

void SceneView::showReach (bool shows)
{
    reach_button.setToggleState (shows, juce::dontSendNotification);
    changed();
}

/// Begins to drag the handle at this place; false if there is none.
bool SceneView::grabHandle (juce::Point<float> at)
{
    if (! showsReach()) return false;
    for (const auto& reach : shown_reaches)
        if (const auto axis = scene::Overlay::handleAt (seen_by, getLocalBounds().toFloat(), reach, at))
        {
            grabbed = Grabbed { reach.role, { *axis, 0.0 } };
            return true;
        }
    return false;
}

void SceneView::dropHandle()
{
    const auto* reach = grabbedReach();
    if (reach != nullptr && grabbed->by.metres != 0.0 && onMoveOrigin)
        onMoveOrigin (std::string (grabbed->role), reach->origin + grabbed->by.metres * Vec3::Unit (grabbed->by.axis));
    grabbed.reset();
    refreshReaches();
    changed();
}

void SceneView::drawReaches (scene::Overlay& overlay) const
{
    if (! showsReach()) return;
    for (const auto& reach : shown_reaches)
    {
        const bool is_grabbed = grabbed && grabbed->role == reach.role;
        const auto by = is_grabbed ? std::optional (grabbed->by) : std::nullopt;
        overlay.drawReach (by ? reach.movedBy (by->metres * Vec3::Unit (by->axis)) : reach, shown_reaches.size() > 1, by);
    }
}

void SceneView::changed()
{
    is_dirty = true;
    still_for = 0;
    repaint();
}

void SceneView::describe()
{
    juce::String text;
    for (const auto& tool : now.tools)
        text += juce::String (tool.role) + ": " + scene::Overlay::forceText (tool.force.norm()) + ". ";
    setDescription (text.trim());
}

std::unique_ptr<juce::AccessibilityHandler> SceneView::createAccessibilityHandler()
{
    return std::make_unique<juce::AccessibilityHandler> (*this, juce::AccessibilityRole::image);
}

void SceneView::frameAll()
{
    follow_button.setToggleState (false, juce::dontSendNotification);
    seen_by.setSize (static_cast<float> (getWidth()), static_cast<float> (getHeight()));
    for (int i = 0; i < 2; ++i)   // how large a tool is drawn depends on the distance
    {
        auto box = stage.bounds();
        constexpr double far = 1.0;   // m; a tool that an unstable loop has thrown away is not worth the picture
        for (const auto& tool : now.tools)
        {
            if (! isFinite (tool.position) || tool.position.norm() > far) continue;
            box.add (tool.position);
            for (const auto& line : stage.linesOf (tool, seen_by, now))
                for (const auto& end : line)
                    box.add (end);
        }
        for (const auto& reach : shown_reaches)
            if (showsReach() && reach.middle.norm() < far)
                for (const auto& corner : reach.corners())
                    box.add (corner);
        seen_by.frame (box);
    }
    is_framed = ! stage.bounds().isEmpty() && getWidth() > 0;
    changed();
}

void SceneView::lookAlong (int axis)
{
    constexpr double quarter = juce::MathConstants<double>::halfPi;
    const double before_yaw = seen_by.yaw, before_pitch = seen_by.pitch;
    const auto set = [&] (double yaw, double pitch) {
        seen_by.yaw = yaw;
        seen_by.pitch = pitch;
    };
    const double level = 0.02, above = quarter - 0.02;
    const std::array<std::array<double, 4>, 3> views {
        { { quarter, level, -quarter, level }, { 0.0, level, 2.0 * quarter, level }, { 0.0, above, 0.0, -above } }
    };
    const auto& v = views[static_cast<std::size_t> (axis)];
    set (v[0], v[1]);
    if (std::abs (seen_by.yaw - before_yaw) < 1e-9 && std::abs (seen_by.pitch - before_pitch) < 1e-9) set (v[2], v[3]);
    changed();
}

void SceneView::follow (bool f)
{
    follow_button.setToggleState (f, juce::dontSendNotification);
    changed();
}

void SceneView::resized()
{
    auto row = getLocalBounds().reduced (8).removeFromTop (24);
    for (auto* b : { &follow_button, &frame_button, &reach_button })
    {
        b->setBounds (row.removeFromLeft (b->wantedWidth()));
        row.removeFromLeft (4);
    }
    seen_by.setSize (static_cast<float> (getWidth()), static_cast<float> (getHeight()));
    if (! is_framed) frameAll();
    changed();
}

/// Draws all surfaces into the image, with as many samples as there is time for.
void SceneView::drawSurfaces (float pixels_per_unit)
{
    constexpr float most_pixels = 2.1e6f;   // as large as a window of 1920 x 1080; larger pictures are scaled up
    pixels_per_unit = std::min (pixels_per_unit, std::sqrt (most_pixels / static_cast<float> (getWidth() * getHeight())));
    const auto inPixels = [pixels_per_unit] (int units) { return juce::roundToInt (static_cast<float> (units) * pixels_per_unit); };
    const int width = inPixels (getWidth()), height = inPixels (getHeight());
    if (surfaces.getWidth() != width || surfaces.getHeight() != height) surfaces = juce::Image (juce::Image::ARGB, width, height, true);
    const auto begin = juce::Time::getMillisecondCounterHiRes();
    auto camera = seen_by;
    camera.setSize (static_cast<float> (width), static_cast<float> (height));
    const bool is_at_rest = still_for >= rest_after;
    const int fineness = is_at_rest || ! is_slow ? 2 : 1;
    is_coarse = ! is_at_rest;
    raster.begin (width, height, fineness, is_at_rest ? scene::Raster::Shading::sample : scene::Raster::Shading::pixel);
    stage.draw (raster, camera, scene::Paint (themeOf (*this)), now);
    raster.write (surfaces);
    painted_ms = juce::Time::getMillisecondCounterHiRes();
    took_s = 1e-3 * (painted_ms - begin);
    if (fineness == 2 && ! is_at_rest) is_slow = took_s > slow_s;
    if (fineness == 1 && took_s < 0.2 * slow_s) is_slow = false;
}

void SceneView::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto area = getLocalBounds().toFloat();
    g.setColour (look.theme().canvas);
    g.fillRoundedRectangle (area, 4.0f);
    if (getWidth() < 2 || getHeight() < 2) return;
    const juce::Graphics::ScopedSaveState clipped (g);
    g.reduceClipRegion (getLocalBounds());
    scene::Overlay overlay (g, look, seen_by, area);
    if (stage.isEmpty() && now.tools.empty() && (shown_reaches.empty() || ! showsReach()))
    {
        g.setColour (look.theme().dim);
        g.setFont (look.font (13.0f));
        const auto& run = playback.current();
        const auto text = ! run.isRunning() && hasErrors (run.messages()) ? TRANS ("Cannot run: see Problems.")
                                                                          : TRANS ("Nodes with a surface appear here, such as a plane or a mesh.");
        return g.drawFittedText (text, getLocalBounds().reduced (24), juce::Justification::centred, 2);
    }
    overlay.drawGround (stage);
    drawSurfaces (std::clamp (g.getInternalContext().getPhysicalPixelScaleFactor(), 1.0f, 3.0f));
    g.drawImage (surfaces, area);
    drawReaches (overlay);
    overlay.drawMarks (stage, now);
    overlay.drawScale (stage, now);
    overlay.drawAxes();
}

bool SceneView::isOnTool (juce::Point<float> at) const
{
    const auto* tool = handTool();
    if (tool == nullptr) return false;
    const auto seen = seen_by.see (tool->position);
    const auto reach = std::max (14.0f, static_cast<float> (1.2 * scene::Scene::tipRadius (*tool, seen_by) * seen_by.scaleAt (seen.depth)));
    if (juce::Point<float> (seen.x, seen.y).getDistanceFrom (at) < reach) return true;
    return std::ranges::any_of (stage.linesOf (*tool, seen_by, now), [&] (const auto& line) {
        juce::Point<float> nearest;
        const juce::Line<float> shown (seen_by.pixel (line[0]), seen_by.pixel (line[1]));
        return shown.getDistanceFromPoint (at, nearest) < reach;
    });
}

/// Presses the tool where the pointer meets the plane z = 0, as far from it as it was grabbed. Above the horizon, the tool stays where it is.
void SceneView::press (juce::Point<float> at)
{
    at += grabbed_at;
    const Vec3 ray = seen_by.ray (at), eye = seen_by.eye();
    const double reach = std::abs (ray.z()) < 1e-3 ? 0.0 : -eye.z() / ray.z();
    constexpr double far = scene::Sheet3D::half_width;
    if (reach > 0.0) steered_to = (eye + reach * ray).cwiseMax (-far).cwiseMin (far);
    if (onSteer) onSteer (steered_to.x(), steered_to.y(), true);
}

/// Ends a drag. The tool stops pressing wherever the pointer is.
void SceneView::release()
{
    grabbed.reset();
    if (std::exchange (drag, Drag::none) == Drag::tool && onSteer) onSteer (steered_to.x(), steered_to.y(), false);
}

void SceneView::mouseMove (const juce::MouseEvent& e)
{
    const bool is_gizmo = scene::Overlay::axisAt (seen_by, getLocalBounds().toFloat(), e.position).has_value();
    const auto isHandle = [&] (const scene::Reach& reach) {
        return scene::Overlay::handleAt (seen_by, getLocalBounds().toFloat(), reach, e.position).has_value();
    };
    if (showsReach() && std::ranges::any_of (shown_reaches, isHandle)) return setMouseCursor (juce::MouseCursor::DraggingHandCursor);
    const auto plain = is_gizmo ? juce::MouseCursor::PointingHandCursor : juce::MouseCursor::NormalCursor;
    setMouseCursor (isOnTool (e.position) ? juce::MouseCursor::CrosshairCursor : plain);
}

void SceneView::mouseDown (const juce::MouseEvent& e)
{
    takeFocus (*this);
    dragged_to = e.position;
    drag = e.mods.isShiftDown() || e.mods.isRightButtonDown() ? Drag::move : Drag::turn;
    if (drag == Drag::turn && e.mods.isLeftButtonDown() && grabHandle (e.position))
    {
        drag = Drag::reach;
        return changed();
    }
    if (drag == Drag::turn && e.mods.isLeftButtonDown() && isOnTool (e.position))
    {
        drag = Drag::tool;
        grabbed_at = seen_by.pixel (handTool()->position) - e.position;
        constexpr double far = scene::Sheet3D::half_width;
        steered_to = handTool()->position.cwiseMax (-far).cwiseMin (far);
        return press (e.position);
    }
    if (const auto axis = scene::Overlay::axisAt (seen_by, getLocalBounds().toFloat(), e.position))
    {
        drag = Drag::none;
        lookAlong (*axis);
    }
}

void SceneView::mouseDrag (const juce::MouseEvent& e)
{
    const auto by = e.position - dragged_to;
    dragged_to = e.position;
    if (drag == Drag::tool) return press (e.position);
    if (const auto* reach = grabbedReach(); drag == Drag::reach && reach != nullptr)
    {
        auto& [axis, metres] = grabbed->by;
        const double most = 0.5;   // m; from a camera far away, a pixel is much
        metres = std::clamp (metres + scene::Overlay::dragged (seen_by, reach->movedBy (metres * Vec3::Unit (axis)), axis, by), -most, most);
    }
    if (drag == Drag::turn) seen_by.orbit (-radians_per_pixel * static_cast<double> (by.x), radians_per_pixel * static_cast<double> (by.y));
    if (drag == Drag::move)
    {
        seen_by.pan (by);
        follow_button.setToggleState (false, juce::dontSendNotification);
    }
    changed();
}

void SceneView::mouseUp (const juce::MouseEvent&)
{
    if (drag == Drag::reach) dropHandle();
    release();
}

void SceneView::mouseDoubleClick (const juce::MouseEvent& e)
{
    if (! isOnTool (e.position) && ! scene::Overlay::axisAt (seen_by, getLocalBounds().toFloat(), e.position)) frameAll();
}

void SceneView::mouseWheelMove (const juce::MouseEvent& e, const juce::MouseWheelDetails& wheel)
{
    if (drag == Drag::tool && onDeeper) return onDeeper (-2.0 * static_cast<double> (wheel.deltaY));
    seen_by.zoomAbout (follows() ? getLocalBounds().toFloat().getCentre() : e.position, std::exp2 (1.6 * static_cast<double> (wheel.deltaY)));
    changed();
}

void SceneView::mouseMagnify (const juce::MouseEvent& e, float factor)
{
    seen_by.zoomAbout (e.position, static_cast<double> (factor));
    changed();
}

bool SceneView::keyPressed (const juce::KeyPress& key)
{
    using K = juce::KeyPress;
    const auto centre = getLocalBounds().toFloat().getCentre();
    const auto character = juce::CharacterFunctions::toLowerCase (key.getTextCharacter());
    const bool moves = key.getModifiers().isShiftDown();
    if (key.getModifiers().isCommandDown() || key.getModifiers().isAltDown()) return false;
    const std::array<std::pair<int, juce::Point<float>>, 4> arrows {
        { { K::leftKey, { -1, 0 } }, { K::rightKey, { 1, 0 } }, { K::upKey, { 0, -1 } }, { K::downKey, { 0, 1 } } }
    };
    for (const auto& [code, way] : arrows)
        if (key.getKeyCode() == code)
        {
            if (moves)
                seen_by.pan (-key_step * way);
            else
                seen_by.orbit (radians_per_pixel * static_cast<double> (key_step * way.x), -radians_per_pixel * static_cast<double> (key_step * way.y));
            changed();
            return true;
        }
    if (character == '+' || character == '=' || character == '-')
    {
        seen_by.zoomAbout (centre, character == '-' ? 1.0 / 1.2 : 1.2);
        changed();
        return true;
    }
    if (character == 'f') return frameAll(), true;
    if (character == 't') return follow (! follows()), true;
    if (key.getKeyCode() != K::homeKey) return false;
    const scene::Camera fresh;
    seen_by.yaw = fresh.yaw;
    seen_by.pitch = fresh.pitch;
    frameAll();
    return true;
}

}   // namespace tactus::host
