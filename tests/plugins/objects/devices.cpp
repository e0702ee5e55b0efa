// SPDX-License-Identifier: MIT
// Device nodes of the catalogue, as a plugin.
#include <tactus/plugin/node_plugin.hpp>

#include <tactus/nodes/device/axis.hpp>
#include <tactus/nodes/device/brake.hpp>
#include <tactus/nodes/device/force.hpp>
#include <tactus/nodes/device/position.hpp>

TACTUS_PLUGIN (tactus::nodes::DeviceAxis, tactus::nodes::DeviceBrake, tactus::nodes::DevicePosition, tactus::nodes::DeviceForce)
