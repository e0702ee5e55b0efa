// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/nodes/contact/impact.hpp>
#include <tactus/nodes/contact/window.hpp>
#include <tactus/nodes/deform/surface.hpp>
#include <tactus/nodes/device/force.hpp>
#include <tactus/nodes/device/position.hpp>
#include <tactus/nodes/friction/elasto_plastic.hpp>
#include <tactus/nodes/hold/predictive.hpp>
#include <tactus/nodes/motion/velocity.hpp>
#include <tactus/nodes/safety/passivity.hpp>
#include <tactus/nodes/shock/hunt_crossley.hpp>
#include <tactus/nodes/signal/add.hpp>
#include <tactus/nodes/texture/grating.hpp>
#include <tactus/nodes/texture/noise.hpp>
#include <tactus/nodes/vector/add.hpp>
#include <tactus/nodes/vector/scale.hpp>
#include <tactus/nodes/vibration/modal.hpp>

namespace tactus::bench
{

inline const Setup kernel_setup { .rate_hz = 4000.0 };

/// Runs the hooks of a node that follow its params and settings.
template <typename N>
void start (N& node)
{
    if constexpr (Preparable<N>) node.prepare (kernel_setup);
    if constexpr (Updatable<N>) node.update();
}

/// The twenty nodes of graphs/padded_bench.json, under the same names and with the same settings as in the file, for the variants
/// that do not use the framework.
struct Kernels
{
    explicit Kernels (const DeviceState&);

    nodes::DevicePosition hand;
    nodes::Velocity motion;
    nodes::ElasticSurface foam;
    nodes::ElastoPlastic drag;
    nodes::Grating ribs, warp, weft;
    nodes::TextureNoise hiss;
    nodes::ContactWindow touch;
    nodes::VectorAdd cloth;
    nodes::VectorScale felt;
    nodes::Impact landing;
    nodes::HuntCrossley thud;
    nodes::Modal wood;
    nodes::SignalAdd bump;
    nodes::VectorScale up;
    nodes::VectorAdd all;
    nodes::PassivityObserver calm;
    nodes::PredictiveHold limit;
    nodes::DeviceForce motor;
};

}   // namespace tactus::bench
