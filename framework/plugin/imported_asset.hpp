// SPDX-License-Identifier: MIT
#pragma once

/// Contents of files, and surfaces, as the side that receives them (host or plugin) reads them.

#include "law_value.hpp"

#include <tactus/kit/assets.hpp>
#include <tactus/kit/geometry/surface.hpp>

#include <map>
#include <memory>
#include <mutex>

namespace tactus::plugin
{

/// The choice whether a copy also retains the asset. If so, the same asset gives the same copy as long as that copy is in use. If not, the copy can
/// outlive the plugin.
enum class Keep
{
    yes,
    no
};

inline Signal copyOf (const tactus_plugin_signal& s)
{
    Signal copy { .rate_hz = s.rate_hz, .channels = {} };
    for (std::size_t c = 0; c < s.channel_count; ++c)
        copy.channels.emplace_back (s.channels[c], s.channels[c] + s.sample_count);
    return copy;
}

inline Grid copyOf (const tactus_plugin_grid& g) { return { g.rows, g.columns, { g.values, g.values + at (g.rows) * at (g.columns) } }; }

inline Mesh copyOf (const tactus_plugin_mesh& m)
{
    Mesh copy;
    for (std::size_t i = 0; i < m.point_count; ++i)
        copy.points.emplace_back (m.points[3 * i], m.points[3 * i + 1], m.points[3 * i + 2]);
    for (std::size_t i = 0; i < m.triangle_count; ++i)
        copy.triangles.push_back ({ m.triangles[3 * i], m.triangles[3 * i + 1], m.triangles[3 * i + 2] });
    return copy;
}

/// The copy of an asset; null for null. Content is the C struct that the asset holds. [any thread]
template <typename T, typename Content>
std::shared_ptr<const T> imported (const tactus_plugin_asset*, Keep);

inline Surface copyOf (const tactus_plugin_surface& s, Keep keep)
{
    Surface copy;
    copy.mesh = imported<Mesh, tactus_plugin_mesh> (s.mesh, keep);
    for (std::size_t f = 0; f < s.frame_count; ++f)
    {
        auto& frame = copy.frames.emplace_back();
        for (int i = 0; i < 9; ++i)
            frame (i / 3, i % 3) = s.frames[9 * f + at (i)];
    }
    const auto* const* law = s.curves;
    for (std::size_t t = 0; t < s.tool_count; ++t)
    {
        auto& tool = copy.curves.emplace_back (s.tools[t]);
        for (auto& curves : tool)
            for (auto& along : curves)
                along = readLaw (**law++);
    }
    for (std::size_t i = 0; i < s.mu_count; ++i)
    {
        auto& mu = copy.mu.emplace_back();
        if (s.mu[i]->kind == TACTUS_PLUGIN_LAW)
            mu.law = readLaw (*s.mu[i]);
        else if (s.mu[i]->kind == TACTUS_PLUGIN_CURVE)
            mu.curve = readCurve (*s.mu[i]);
        else
            mu.number = s.mu[i]->a;
    }
    const double* shares = s.weights;
    for (std::size_t t = 0; t < s.weighted_count; ++t)
        for (auto& entry : copy.weights.emplace_back (s.weight_counts[t]))
        {
            entry.assign (shares, shares + s.tool_count);
            shares += s.tool_count;
        }
    return copy;
}

template <typename T, typename Content>
std::shared_ptr<const T> imported (const tactus_plugin_asset* asset, Keep keep)
{
    if (asset == nullptr) return nullptr;
    const auto& content = *static_cast<const Content*> (asset->content);
    const auto copy = [&] {
        if constexpr (std::is_same_v<T, Surface>)
            return new T (copyOf (content, keep));
        else
            return new T (copyOf (content));
    };
    if (keep == Keep::no) return std::shared_ptr<const T> (copy());

    static std::mutex guard;
    static std::map<const tactus_plugin_asset*, std::weak_ptr<const T>> all;
    const std::scoped_lock lock { guard };
    if (auto known = all[asset].lock()) return known;
    asset->retain (asset);
    const auto forget = [asset] (const T* unused) {
        delete unused;
        {
            const std::scoped_lock now { guard };
            if (const auto found = all.find (asset); found != all.end() && found->second.expired()) all.erase (found);
        }
        asset->release (asset);
    };
    const std::shared_ptr<const T> made (copy(), forget);
    all[asset] = made;
    return made;
}

}   // namespace tactus::plugin
