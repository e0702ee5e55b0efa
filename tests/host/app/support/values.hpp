// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/assets/file_assets.hpp>
#include <tactus/plan/flat/flatten.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace tactus::host::test
{

/// The numbers that a graph runs with: those of every param, by the node of the graph that it belongs to. A node of a subgraph that is used
/// more than once has several.
using ValuesInEffect = std::map<std::tuple<graph::Id, std::string, int>, std::vector<double>>;

inline ValuesInEffect valuesInEffect (const graph::Graph& g)
{
    FileAssets assets;
    const auto flattened = plan::flatten (g, catalogue(), {}, &assets, plan::SettingFiles::left_out);
    ValuesInEffect all;
    for (const auto& n : flattened.flat.nodes)
    {
        auto at = n.values;
        for (const auto& row : n.type->params)
            for (int i = 0; i < n.slots (row); ++i)
                all[{ n.identity.id, std::string (row.id), i }].push_back (flattened.flat.values[at++]);
    }
    for (auto& [of, values] : all)
        std::ranges::sort (values);
    return all;
}

/// Names a value that is in both and differs; empty if there is none. A node whose copies have come or gone is left out.
inline std::string changedValue (const ValuesInEffect& before, const ValuesInEffect& after)
{
    for (const auto& [of, values] : before)
    {
        const auto now = after.find (of);
        if (now == after.end() || now->second.size() != values.size()) continue;
        for (std::size_t i = 0; i < values.size(); ++i)
            if (! (std::abs (now->second[i] - values[i]) <= 1e-9 * std::abs (values[i]) + 1e-14))
                return std::get<1> (of) + " of node " + std::to_string (std::get<0> (of)) + " went from " + std::to_string (values[i]) + " to "
                       + std::to_string (now->second[i]);
    }
    return {};
}

/// The values of one node, to nine digits.
inline std::vector<std::pair<std::string, double>> valuesOf (const ValuesInEffect& all, graph::Id node)
{
    const auto rounded = [] (double v) {
        const double scale = v == 0.0 ? 1.0 : std::pow (10.0, 8 - std::floor (std::log10 (std::abs (v))));
        return std::round (v * scale) / scale;
    };
    std::vector<std::pair<std::string, double>> found;
    for (const auto& [of, values] : all)
        if (std::get<0> (of) == node)
            for (const double v : values)
                found.emplace_back (std::get<1> (of), rounded (v));
    return found;
}

}   // namespace tactus::host::test
