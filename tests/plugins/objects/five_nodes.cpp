// SPDX-License-Identifier: MIT
// Five nodes of the catalogue, as a plugin.
#include <tactus/plugin/node_plugin.hpp>

#include <tactus/nodes/deform/surface.hpp>
#include <tactus/nodes/device/force.hpp>
#include <tactus/nodes/friction/elasto_plastic.hpp>
#include <tactus/nodes/signal/expression.hpp>
#include <tactus/nodes/texture/noise.hpp>

TACTUS_PLUGIN (tactus::nodes::ElastoPlastic, tactus::nodes::ElasticSurface, tactus::nodes::TextureNoise, tactus::nodes::SignalExpression,
               tactus::nodes::DeviceForce)
