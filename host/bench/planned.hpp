// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "variant.hpp"

#include <tactus/graph/graph.hpp>
#include <tactus/plan/compile.hpp>

namespace tactus::bench
{

/// A graph run by Tactus. The input is the tool position if the graph has a device, otherwise a feed.
class Planned : public Variant
{
public:
    /// Throws if the graph does not compile.
    explicit Planned (const graph::Graph&, const CompileOptions& = {}, const Catalogue& = catalogue());

    void tick (const double* in) noexcept override;
    const std::shared_ptr<Plan>& running() const noexcept { return plan; }
    std::vector<double> outputs() const override;   ///< the force on the device, or the recorded ports if there is no device

private:
    std::shared_ptr<Plan> plan;
    DeviceState* device = nullptr;
};

}   // namespace tactus::bench
