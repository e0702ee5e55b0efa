// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nodes/contact/impact.hpp>
#include <nodes/contact/window.hpp>
#include <nodes/deform/surface.hpp>
#include <nodes/device/force.hpp>
#include <nodes/device/position.hpp>
#include <nodes/friction/elasto_plastic.hpp>
#include <nodes/hold/predictive.hpp>
#include <nodes/motion/velocity.hpp>
#include <nodes/safety/passivity.hpp>
#include <nodes/shock/hunt_crossley.hpp>
#include <nodes/signal/add.hpp>
#include <nodes/texture/grating.hpp>
#include <nodes/texture/noise.hpp>
#include <nodes/vector/add.hpp>
#include <nodes/vector/scale.hpp>
#include <nodes/vibration/modal.hpp>

namespace tactus::bench
{

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
