// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/tool_faces.hpp>
#include <tactus/node/generic.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace tactus::nodes
{

/// The part of a tool that touches: its tip, an edge or a flat side. Wire it to `tool` of deform.surface. A probe that comes down upright then sinks
/// in with its tip, and one that lies down meets the body with its side.
///
///     q_i  = 1 - a_i . m                      a_i: direction of face i of the tool in the world; m: into the body, -normal
///     w_i  = (1 / q_i) / sum_j (1 / q_j)      shares of the faces, convex: the outer weights of (8) and (9)
///     tool = sum_i w_i tool_i
///
/// deform.surface reads `tool` at the start of a contact. So the tilt at the touch counts, and a hand that tilts the tool while it presses
/// changes nothing until it has let go.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 4, eq. (8) and (9); weights: Shepard 1968, on the sphere.
///
/// Good to know
///  - A face that looks straight into the body has all the share. Between two faces of the same distance, each has half.
///  - A number between those of two tools blends these two. So give faces that lie side by side numbers that follow each other, or define
///    the blends as `weights` of the surface.
///  - On a flat body that faces up, `normal` needs no wire. On any other body, wire its `normal` here, each component through a signal.delay
///    of one tick: the normal of the nearest patch is known before the touch.
///  - A tool that points down at rest has its tip at (0, 0, -1).
struct DeformTool
{
    struct Face
    {
        Vec3 direction = -Vec3::UnitZ();
        double tool = 0.0;

        static constexpr std::tuple fields {
            field (&Face::direction, "direction", unit::gain, "out of the tool, in its own axes; any length but 0"),
            field (&Face::tool, "tool", unit::count, "number of the tool that a body meets in this face", { .hard = { 0, inf }, .usual = { 0, 10 } }),
        };
    };

    struct Inputs
    {
        Vec3 rotation = Vec3::Zero();
        Vec3 normal = Vec3::UnitZ();
    };

    using Params = Empty;

    struct Settings
    {
        std::vector<Face> faces { { .direction = -Vec3::UnitZ(), .tool = 0.0 }, { .direction = Vec3::UnitX(), .tool = 1.0 } };
    };

    struct Outputs
    {
        double tool = 0.0;
        Vec3 turn = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "deform.tool",
        .name = "Tool faces",
        .summary = "Which part of a tool touches, by its tilt: tip, edge or side.",
        .source = "Hayward 2007, section 4, eq. (8) and (9)",
        .keywords = "tilt orientation probe tip side edge weights shape",
    };

    static constexpr std::tuple ports {
        input (&Inputs::rotation, "rotation", unit::radian, "rotation of the tool: axis times angle"),
        input (&Inputs::normal, "normal", unit::gain, "direction out of the body; any length but 0"),
        setting (&Settings::faces, "faces", unit::count, "faces, edges and tips of the tool, 1 to 8"),
        output (&Outputs::tool, "tool", unit::count, "number of the tool that touches, for deform.surface"),
        output (&Outputs::turn, "turn", Unit { Quantity::any, { 0, 0, 0 }, "1/rad" }, "gradient of tool when the tool turns, about the axes of the world"),
    };

    Params params;
    Settings settings;

    std::string problem() const
    {
        const auto& given = settings.faces;
        if (given.empty() || given.size() > most_faces) return "faces needs from 1 to " + std::to_string (most_faces) + " faces";
        for (std::size_t i = 0; i < given.size(); ++i)
        {
            if (direction (given[i].direction).isZero (0.0)) return "face " + std::to_string (i + 1) + " has no direction";
            for (std::size_t j = 0; j < i; ++j)
                if (direction (given[i].direction).cross (direction (given[j].direction)).norm() < smallest_angle
                    && given[i].direction.dot (given[j].direction) > 0.0)
                    return "faces " + std::to_string (j + 1) + " and " + std::to_string (i + 1) + " look in the same direction";
        }
        return "";
    }

    void prepare (const Setup&)
    {
        faces.clear();
        for (const auto& face : settings.faces)
            faces.push_back ({ direction (face.direction), face.tool });
    }

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.rotation, in.normal)) return {};
        const auto tilt = tiltOf (faces, rotationMatrix (in.rotation), -direction (in.normal));
        return { .tool = tilt.tool, .turn = tilt.turn };
    }

    void serialize (auto&) {}

private:
    static constexpr double smallest_angle = 1e-3;   // between two faces, in rad

    std::vector<ToolFace> faces;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeformTool);
