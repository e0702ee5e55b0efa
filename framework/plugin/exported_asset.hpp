// SPDX-License-Identifier: MIT
#pragma once

/// Contents of files, and surfaces, as the side that owns them (host or plugin) shows them to the other side.

#include "law_value.hpp"

#include <tactus/kit/assets.hpp>
#include <tactus/kit/geometry/surface.hpp>

#include <map>
#include <mutex>
#include <type_traits>
#include <utility>

namespace tactus::plugin
{

/// Shows a Signal, Grid, Mesh or Surface to the other side. As long as the asset is in use, the same original gives the same asset:
/// nodes recognise a mesh by its address.
class ExportedAsset : public tactus_plugin_asset
{
public:
    ExportedAsset (const ExportedAsset&) = delete;
    ExportedAsset& operator= (const ExportedAsset&) = delete;

    /// The asset of an original, which the caller must release. Null for null. [any thread]
    template <typename T>
    static const tactus_plugin_asset* of (const std::shared_ptr<const T>& original, int kind)
    {
        if (! original) return nullptr;
        const std::scoped_lock lock { registry().guard };
        auto& made = registry().all[{ kind, original.get() }];
        if (made == nullptr)
        {
            made = new ExportedAsset (kind, original);
            made->show (*original);
        }
        ++made->uses;
        return made;
    }

private:
    struct Registry
    {
        std::recursive_mutex guard;   // recursive, because showing a surface also shows its mesh
        std::map<std::pair<int, const void*>, ExportedAsset*> all;
    };

    static Registry& registry()
    {
        static Registry one;
        return one;
    }

    ExportedAsset (int kind_, std::shared_ptr<const void> o) : tactus_plugin_asset {}, original (std::move (o))
    {
        size = sizeof (tactus_plugin_asset);
        kind = kind_;
        retain = [] (const tactus_plugin_asset* a) noexcept {
            const std::scoped_lock lock { registry().guard };
            ++mine (a)->uses;
        };
        release = [] (const tactus_plugin_asset* a) noexcept { mine (a)->drop(); };
    }

    ~ExportedAsset()
    {
        if (surface.mesh != nullptr) surface.mesh->release (surface.mesh);
    }

    static ExportedAsset* mine (const tactus_plugin_asset* a) noexcept { return const_cast<ExportedAsset*> (static_cast<const ExportedAsset*> (a)); }

    void drop() noexcept
    {
        {
            const std::scoped_lock lock { registry().guard };
            if (--uses > 0) return;
            registry().all.erase ({ kind, original.get() });
        }
        delete this;   // after unlocking, because a surface also releases its mesh here
    }

    void show (const Signal& s)
    {
        for (const auto& channel : s.channels)
            channels.push_back (channel.data());
        signal = { sizeof signal, s.rate_hz, channels.data(), channels.size(), s.channels.empty() ? 0 : s.channels.front().size() };
        content = &signal;
    }

    void show (const Grid& g)
    {
        grid = { sizeof grid, g.rows, g.columns, g.values.data() };
        content = &grid;
    }

    void show (const Mesh& m)
    {
        mesh = meshOf (m);
        content = &mesh;
    }

    void show (const Surface& s);

    std::shared_ptr<const void> original;
    long uses = 0;

    tactus_plugin_signal signal {};
    tactus_plugin_grid grid {};
    tactus_plugin_mesh mesh {};
    tactus_plugin_surface surface {};

    std::vector<const double*> channels;
    std::vector<double> frames, weights;
    std::vector<std::size_t> tools, weight_counts;
    std::vector<tactus_plugin_value> laws, ratios;
    std::vector<const tactus_plugin_value*> law_list, ratio_list;

public:
    /// The arrays of a mesh, not copied.
    static tactus_plugin_mesh meshOf (const Mesh& m) noexcept
    {
        static_assert (sizeof (Vec3) == 3 * sizeof (double) && sizeof (std::array<int, 3>) == 3 * sizeof (std::int32_t));
        return { sizeof (tactus_plugin_mesh), m.points.empty() ? nullptr : m.points.front().data(), m.points.size(),
                 m.triangles.empty() ? nullptr : m.triangles.front().data(), m.triangles.size() };
    }
};

inline std::vector<const tactus_plugin_value*> addressesOf (const std::vector<tactus_plugin_value>& all)
{
    std::vector<const tactus_plugin_value*> list;
    for (const auto& v : all)
        list.push_back (&v);
    return list;
}

inline void ExportedAsset::show (const Surface& s)
{
    for (const auto& frame : s.frames)
        for (int i = 0; i < 9; ++i)
            frames.push_back (frame (i / 3, i % 3));
    for (const auto& tool : s.curves)
    {
        tools.push_back (tool.size());
        for (const auto& curves : tool)
            for (const auto& law : curves)
                laws.push_back (lawValue (law));
    }
    for (const auto& mu : s.mu)
        ratios.push_back (mu.law ? lawValue (mu.law) : mu.curve.empty() ? numberValue (mu.number)
                                                                        : curveValue (mu.curve));
    for (const auto& tool : s.weights)
    {
        weight_counts.push_back (tool.size());
        for (const auto& shares : tool)
            weights.insert (weights.end(), shares.begin(), shares.end());
    }
    law_list = addressesOf (laws);
    ratio_list = addressesOf (ratios);

    surface.size = sizeof surface;
    surface.mesh = of (s.mesh, TACTUS_PLUGIN_MESH);
    surface.frames = frames.data();
    surface.frame_count = s.frames.size();
    surface.tools = tools.data();
    surface.tool_count = tools.size();
    surface.curves = law_list.data();
    surface.mu = ratio_list.data();
    surface.mu_count = ratios.size();
    surface.weights = weights.data();
    surface.weight_counts = weight_counts.data();
    surface.weighted_count = weight_counts.size();
    content = &surface;
}

}   // namespace tactus::plugin
