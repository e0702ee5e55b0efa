// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solid.hpp"

#include <array>

namespace tactus::host::scene
{

/// A tool, as its device measures it, and the force on it.
struct Tool
{
    std::string role {};
    Vec3 position = Vec3::Zero();   ///< m
    Vec3 force = Vec3::Zero();      ///< N
};

/// The state of the tools and bodies, which changes from picture to picture.
struct SceneState
{
    std::vector<Tool> tools {};
    std::vector<PartValues> live {};   ///< by body: values of its ports; empty where nothing runs

    const Tool* tool (const std::string& role) const noexcept;
    std::optional<Vec3> of (std::size_t body, std::string_view Appearance::*part) const noexcept
    {
        return body < live.size() ? live[body][partNumber (part)] : std::nullopt;
    }
};

/// A tool that is held at a point of a surface: in contact, or stretched sideways.
struct Touch
{
    std::string role {};
    Vec3 at = Vec3::Zero();       ///< the point of the surface, before it moved
    Vec3 tool = Vec3::Zero();     ///< the position of the tool
    double depth = 0.0;           ///< m
    Vec3 normal = Vec3::Zero();   ///< of the plane that is touched; 0 for a mesh
};

/// A round tool, as a body feels it.
struct RoundTool
{
    Vec3 centre = Vec3::Zero();   ///< m
    double radius = 0.0;          ///< m
};

/// The bound of a contact that sticks: a circle on the surface around the point that holds the tool. A tool that is pulled past it slides. Hayward 2007,
/// Fig. 9.
struct StuckBound
{
    Vec3 centre = Vec3::Zero(), normal = Vec3::UnitZ();   ///< m; out of the body
    double radius = 0.0;                                  ///< m
};

/// An open crack under a blade: a rectangle that hangs from the surface.
struct Crack
{
    Vec3 begin = Vec3::Zero(), end = Vec3::Zero();   ///< its upper edge, on the surface
    Vec3 down = Vec3::Zero();                        ///< from there to its tip
};

/// The bodies of a graph as a picture shows them.
class Scene
{
public:
    /// Meshes that are still there are kept.
    void setBodies (std::vector<Body>);
    const std::vector<Body>& bodies() const noexcept { return all; }
    bool isEmpty() const noexcept { return all.empty(); }

    /// The bounds of what a picture should show as a whole, wherever the tools are.
    Bounds bounds() const noexcept;

    /// The lines through what is drawn of a tool: its shaft, and the edge of a blade.
    std::vector<std::array<Vec3, 2>> linesOf (const Tool&, const Camera&, const SceneState&) const;

    /// The radius with which the tip of a tool is drawn, in m: easy to see, but never too large.
    static double tipRadius (const Tool&, const Camera&) noexcept;

    /// Draws everything that has a surface: planes, meshes, blades, plates and tools.
    void draw (Raster&, const Camera&, const Paint&, const SceneState&) const;

    std::vector<Touch> touches (const SceneState&) const;

    /// True if a tool is inside a mesh that it does not feel: it began there, or the mesh was moved over it. It has to come out once.
    bool hasUnfeltTool (const SceneState&) const;

    std::vector<Crack> cracks (const SceneState&) const;
    std::vector<RoundTool> roundTools (const SceneState&) const;

    /// Only of bodies with one mu for all nodes.
    std::vector<StuckBound> stuckBounds (const SceneState&) const;

    /// Distance of the lines of the ground grid, for a camera: 1, 10 or 100 mm.
    static double gridFor (const Camera&) noexcept;

    int triangles() const noexcept;
    bool hasSolid() const noexcept { return ! solids.empty(); }

private:
    std::vector<Sheet3D> sheetsOf (const SceneState&) const;
    Vec3 originOf (std::size_t body, const SceneState&) const;
    void drawBlade (Raster&, const Camera&, const Paint&, const Body&, std::size_t number, const SceneState&) const;
    void drawScissors (Raster&, const Camera&, const Paint&, const Body&, std::size_t number, const SceneState&) const;
    void drawTool (Raster&, const Camera&, const Paint&, const Tool&) const;

    std::vector<Body> all;
    std::vector<std::pair<std::size_t, std::shared_ptr<const Solid>>> solids;   // the number of the body, and its mesh
};

}   // namespace tactus::host::scene
