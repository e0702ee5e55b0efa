// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/assets/file_assets.hpp>
#include <tactus/graph/graph.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>

#include <memory>

namespace tactus::host
{

/// The size in bytes of the files that the settings of a graph, its subgraphs and the graphs that it includes name. [any thread]
double assetBytes (const graph::Graph&);

/// The files of a graph, and a plan that uses them. They last as long as this object, or as other plans use them.
struct LoadedAssets
{
    FileAssets assets;
    Compiled compiled;
};

/// Reads the files of a graph, and computes the data that its nodes need. On another thread, it leaves the main thread only to take them over. [any thread]
std::shared_ptr<const LoadedAssets> loadAssets (const graph::Graph&, const Catalogue&);

}   // namespace tactus::host
