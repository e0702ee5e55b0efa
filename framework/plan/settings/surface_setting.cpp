// SPDX-License-Identifier: MIT
#include "surface_setting.hpp"
#include "files.hpp"

#include <tactus/plan/prepared_shelf.hpp>

namespace tactus::plan
{

namespace
{
constexpr std::string_view axis_names = "a triple of laws, for u^x, u^y and u^z";

const Json* member (const Json& json, const char* name)
{
    const auto found = json.find (name);
    return found == json.end() ? nullptr : &*found;
}

const Json& needed (const Json& json, const char* name, const std::string& key)
{
    const auto* found = member (json, name);
    if (found == nullptr) throw Problem { std::string ("it needs `") + name + "`", key };
    return *found;
}

std::shared_ptr<const Mesh> meshFrom (const Json& json, const Files& files, const std::string& key)
{
    if (const auto* path = member (json, "mesh"))
    {
        for (const auto* other : { "nodes", "triangles", "frames" })
            if (json.contains (other)) throw Problem { std::string ("give either `mesh` or `") + other + "`, not both", under (key, other) };
        return load (&Assets::mesh, *path, files, key + "/mesh");
    }

    Mesh mesh;
    const auto& nodes = listFrom (needed (json, "nodes", key), 0, "a list of points", key + "/nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i)
        mesh.points.push_back (vectorFrom (nodes[i], unit::metre, under (key + "/nodes", i)));
    if (mesh.points.size() < 3) throw Problem { "it needs at least three nodes", key + "/nodes" };

    const Interval index { 0.0, static_cast<double> (mesh.points.size()) - 1.0 };
    const auto& triangles = listFrom (needed (json, "triangles", key), 0, "a list of triangles", key + "/triangles");
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
        const auto here = under (key + "/triangles", i);
        listFrom (triangles[i], 3, "three node numbers, such as [0, 1, 2]", here);
        auto& corners = mesh.triangles.emplace_back();
        for (std::size_t c = 0; c < 3; ++c)
            corners[c] = static_cast<int> (inRange (wholeNumberFrom (triangles[i][c], unit::count, under (here, c)), index, under (here, c)));
    }
    if (mesh.triangles.empty()) throw Problem { "it needs at least one triangle", key + "/triangles" };
    return std::make_shared<const Mesh> (std::move (mesh));
}

/// True if a value is given by shape (weights: by node): it then has a list at this depth, where a value for all shapes (weights: for all
/// nodes) has a number or an object.
bool isByShape (const Json& json, int depth)
{
    const Json* inner = &json;
    for (int i = 0; i < depth; ++i)
    {
        if (! inner->is_array() || inner->empty()) return false;
        inner = &inner->front();
    }
    return inner->is_array();
}

void addFrames (std::vector<Eigen::Matrix3d>& frames, const Json& json, std::size_t nodes, const std::string& key)
{
    listFrom (json, nodes, "one frame for each of the " + std::to_string (nodes) + " nodes", key);
    for (std::size_t i = 0; i < nodes; ++i)
    {
        const auto here = under (key, i);
        listFrom (json[i], 3, "three rows: u^x, u^y and u^z", here);
        auto& frame = frames.emplace_back();
        for (std::size_t row = 0; row < 3; ++row)
            frame.row (static_cast<Eigen::Index> (row)) = vectorFrom (json[i][row], unit::gain, under (here, row)).transpose();
    }
}

std::vector<Eigen::Matrix3d> framesFrom (const Json& json, std::size_t nodes, std::size_t shapes, const std::string& key)
{
    std::vector<Eigen::Matrix3d> frames;
    if (! isByShape (json, 3))
    {
        addFrames (frames, json, nodes, key);
        return frames;
    }
    listFrom (json, shapes, "the frames of each of the " + std::to_string (shapes) + " tools that have curves", key);
    for (std::size_t s = 0; s < shapes; ++s)
        addFrames (frames, json[s], nodes, under (key, s));
    return frames;
}

Surface::Curves axesFrom (const Json& json, const std::string& key)
{
    listFrom (json, 3, std::string (axis_names), key);
    Surface::Curves curves;
    for (std::size_t axis = 0; axis < 3; ++axis)
        curves[axis] = lawFrom (json[axis], unit::metre, unit::newton, under (key, axis));
    return curves;
}

std::vector<std::vector<Surface::Curves>> toolsFrom (const Json& json, std::size_t nodes, const std::string& key)
{
    listFrom (json, 0, "a list of tools, each with its curves", key);
    if (json.empty()) throw Problem { "it needs the curves of at least one tool", key };

    std::vector<std::vector<Surface::Curves>> tools;
    for (std::size_t t = 0; t < json.size(); ++t)
    {
        const auto here = under (key, t);
        const auto& tool = listFrom (json[t], 0, "the curves of a tool", here);
        auto& made = tools.emplace_back();
        if (tool.empty() || ! tool[0].is_array())
        {
            made.push_back (axesFrom (tool, here));
            continue;
        }
        listFrom (tool, nodes, "the curves of each of the " + std::to_string (nodes) + " nodes, or " + std::string (axis_names), here);
        for (std::size_t n = 0; n < nodes; ++n)
            made.push_back (axesFrom (tool[n], under (here, n)));
    }
    return tools;
}

Ratio ratioFrom (const Json& json, const std::string& key)
{
    if (json.is_object() && json.contains ("curve"))
    {
        objectFrom (json, { "curve" }, "a ratio", key);
        const auto curve = curveFrom (json["curve"], unit::metre, unit::gain, key + "/curve");
        for (std::size_t i = 0; i < curve.y.size(); ++i)
            inRange (curve.y[i], { 0.0, inf }, under (key + "/curve/1", i));
        return { .curve = curve };
    }
    if (json.is_object()) return { .law = lawFrom (json, unit::metre, unit::gain, key) };
    return { .number = inRange (numberFrom (json, unit::gain, key), { 0.0, inf }, key) };
}

/// Adds one ratio for all nodes, or one per node. With `all`, a single ratio is repeated for every node.
void addRatios (std::vector<Ratio>& ratios, const Json& json, std::size_t nodes, bool all, const std::string& key)
{
    const bool one = ! json.is_array() || json.size() == 1;
    if (! one) listFrom (json, nodes, "one ratio for each of the " + std::to_string (nodes) + " nodes, or one for all", key);
    if (one)
        ratios.insert (ratios.end(), all ? nodes : 1, json.is_array() ? ratioFrom (json[0], under (key, 0)) : ratioFrom (json, key));
    else
        for (std::size_t n = 0; n < nodes; ++n)
            ratios.push_back (ratioFrom (json[n], under (key, n)));
}

std::vector<Ratio> ratiosFrom (const Json& json, std::size_t nodes, std::size_t shapes, const std::string& key)
{
    std::vector<Ratio> ratios;
    if (! isByShape (json, 1))
    {
        addRatios (ratios, json, nodes, false, key);
        return ratios;
    }
    listFrom (json, shapes, "the ratios of each of the " + std::to_string (shapes) + " tools that have curves", key);
    for (std::size_t s = 0; s < shapes; ++s)
        addRatios (ratios, json[s], nodes, true, under (key, s));
    return ratios;
}

std::vector<double> sharesFrom (const Json& json, std::size_t shapes, const std::string& key)
{
    listFrom (json, shapes, "one share for each of the " + std::to_string (shapes) + " tools that have curves", key);
    std::vector<double> shares;
    for (std::size_t s = 0; s < shapes; ++s)
        shares.push_back (inRange (numberFrom (json[s], unit::gain, under (key, s)), { 0.0, 1.0 }, under (key, s)));
    return shares;
}

std::vector<std::vector<std::vector<double>>> weightsFrom (const Json& json, std::size_t nodes, std::size_t shapes, const std::string& key)
{
    listFrom (json, 0, "a list of tools, each with its weights", key);
    if (json.empty()) throw Problem { "it needs the weights of at least one tool", key };
    std::vector<std::vector<std::vector<double>>> tools;
    for (std::size_t t = 0; t < json.size(); ++t)
    {
        const auto here = under (key, t);
        auto& made = tools.emplace_back();
        if (! isByShape (json[t], 1))
        {
            made.push_back (sharesFrom (json[t], shapes, here));
            continue;
        }
        listFrom (json[t], nodes, "the weights of each of the " + std::to_string (nodes) + " nodes, or one list for all", here);
        for (std::size_t n = 0; n < nodes; ++n)
            made.push_back (sharesFrom (json[t][n], shapes, under (here, n)));
    }
    return tools;
}

std::shared_ptr<const Surface> surfaceOf (const Json& json, std::shared_ptr<const Mesh> mesh, const std::string& key)
{
    Surface s;
    s.mesh = std::move (mesh);
    const auto nodes = s.mesh->points.size();
    s.curves = toolsFrom (needed (json, "curves", key), nodes, key + "/curves");
    const auto shapes = s.curves.size();
    if (const auto* frames = member (json, "frames")) s.frames = framesFrom (*frames, nodes, shapes, key + "/frames");
    s.mu = ratiosFrom (needed (json, "mu", key), nodes, shapes, key + "/mu");
    if (const auto* weights = member (json, "weights")) s.weights = weightsFrom (*weights, nodes, shapes, key + "/weights");
    return std::make_shared<const Surface> (std::move (s));
}
}   // namespace

std::shared_ptr<const Surface> surfaceFrom (const Json& json, const Files& files, const std::string& key)
{
    objectFrom (json, { "nodes", "triangles", "frames", "mesh", "curves", "mu", "weights" }, "it", key);
    const auto make = [&] (std::shared_ptr<const Mesh> mesh) { return surfaceOf (json, std::move (mesh), key); };
    if (member (json, "mesh") == nullptr) return prepared<Surface> (
        &preparedOfAll(), nullptr, [&] { return json.dump(); }, [&] { return make (meshFrom (json, files, key)); });
    const auto mesh = meshFrom (json, files, key);
    return prepared<Surface> (
        &preparedOfAll(), mesh, [&] { return json.dump(); }, [&] { return make (mesh); });
}

}   // namespace tactus::plan
