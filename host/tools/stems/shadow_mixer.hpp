// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// A layer mixer that is computed a second time beside a run, to find the share of each layer.

#include <tactus/kit/signal/mixing_desk.hpp>
#include <tactus/plan/plan.hpp>
#include <tactus/run/probe_ring.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// A port of a node, by the row of its type. Index: of an entry, -1 for none.
plan::PortRef portOf (const plan::Flat&, int node, Role, std::string_view id, int index = -1);

/// The taps of a port, numbers in Plan::taps().
std::vector<std::size_t> tapsOf (const Plan&, const std::string& port);

/// A mixer of a plan that taps its inputs and its output. The share of a layer is the layer as the mixer adds it.
class ShadowMixer
{
public:
    /// Node: the mixer, a number in Flat::nodes. The plan must outlive this object.
    ShadowMixer (const Plan&, int node);

    /// Computes the layers of a tick, the latest of the run.
    void tick (std::uint64_t number);

    /// The share of a layer in a component of the mix, at the i-th of n equal parts of the tick.
    double part (int layer, std::size_t component, int i, int n) const;

    std::string unit() const { return out.empty() ? std::string() : out.front()->unit; }

    int node;
    std::string path;
    std::size_t width;   ///< components of a layer
    int layers = 0;
    double difference = 0.0, peak = 0.0;   ///< between the mix of the run and the sum of the layers, the largest

private:
    template <typename Layer>
    void mix (MixingDesk<Layer>&, const DeskParams&, int t);

    std::vector<const Tap*> in, out;
    int times = 1, period = 1;
    MixingDesk<double> numbers;
    MixingDesk<Vec3> vectors;
    std::array<const double*, 6> given {};
    std::vector<double> values, made;   // made: by sample of the tick, then as `in`
    std::vector<const double*> sources;
};

}   // namespace tactus::host
