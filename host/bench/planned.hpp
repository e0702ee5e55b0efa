// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "variant.hpp"

#include <framework/graph/graph.hpp>
#include <framework/plan/compile.hpp>

namespace tactus::bench
{

/// A graph as Tactus runs it. What comes in is the position of the tool if the graph has a device, else a feed.
class Planned : public Variant
{
public:
    /// Throws if the graph does not compile.
    explicit Planned (const graph::Graph&, const CompileOptions& = {});

    void tick (const double* in) noexcept override;
    std::vector<double> outputs() const override;   ///< the force on the device; without one, what was recorded

private:
    std::shared_ptr<Plan> plan;
    DeviceState* device = nullptr;
};

}   // namespace tactus::bench
