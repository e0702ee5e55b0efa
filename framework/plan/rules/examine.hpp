// SPDX-License-Identifier: MIT
#pragma once

#include "order.hpp"
#include <tactus/plan/flat/flatten.hpp>

namespace tactus::plan
{

/// The result of the steps before building: what they find out about a graph, and all errors and warnings.
struct Examined
{
    Flattened flattened;   ///< the messages are in its `flat`
    PortUnits units {};
    Order order {};
};

/// Flattens a graph and applies all rules that do not involve feeds and records; also to subgraphs that no node uses.
Examined examine (const graph::Graph&, const Catalogue&, const Setup&, std::span<const Override> = {}, Assets* = nullptr,
                  SettingFiles = SettingFiles::read);

}   // namespace tactus::plan
