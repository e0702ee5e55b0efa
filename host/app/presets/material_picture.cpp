// SPDX-License-Identifier: GPL-3.0-or-later
#include "material_picture.hpp"

#include <utility>

namespace tactus::host
{

namespace
{
constexpr double seen_around_tool = 0.009;   // m
constexpr int fineness = 2;                  // samples per pixel in each direction

/// The bounds of what the picture shows.
scene::Bounds boundsFor (const scene::Scene& stage, const scene::SceneState& now)
{
    if (stage.hasSolid() || now.tools.empty()) return stage.bounds();
    const Vec3& tool = now.tools.front().position;
    scene::Bounds box;
    box.add (tool - Vec3 (seen_around_tool, seen_around_tool, 0.5 * seen_around_tool));
    box.add (tool + Vec3 (seen_around_tool, seen_around_tool, 0.5 * seen_around_tool));
    return box;
}
}   // namespace

MaterialPicture materialOf (std::vector<scene::Body> bodies, const scene::SceneState& now)
{
    MaterialPicture picture;
    scene::Scene stage;
    stage.setBodies (std::move (bodies));
    if (stage.isEmpty()) return picture;
    scene::Camera camera;
    camera.setSize (MaterialPicture::width, MaterialPicture::height);
    camera.frame (boundsFor (stage, now));
    for (const auto& [theme, image] : { std::pair (&Theme::dark(), &picture.dark), std::pair (&Theme::light(), &picture.light) })
    {
        scene::Raster raster;
        raster.begin (MaterialPicture::width, MaterialPicture::height, fineness);
        stage.draw (raster, camera, scene::Paint (*theme), now);
        if (raster.coverage() <= 0.0) continue;
        *image = juce::Image (juce::Image::ARGB, MaterialPicture::width, MaterialPicture::height, true);
        raster.write (*image);
    }
    return picture;
}

}   // namespace tactus::host
