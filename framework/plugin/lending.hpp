// SPDX-License-Identifier: MIT
#pragma once

/// The services that the host lends to nodes in plugins, as structs of the C interface.

#include <tactus/tactus_plugin.h>

#include <tactus/node/node.hpp>

#include <vector>

namespace tactus::plugin
{

/// A Setup as the hooks `prepare` and `warning` get it. Valid as long as this object and the Setup exist.
class CSetup
{
public:
    explicit CSetup (const Setup&) noexcept;
    CSetup (const CSetup&) = delete;
    CSetup& operator= (const CSetup&) = delete;

    const tactus_plugin_setup* get() const noexcept { return &setup; }

private:
    tactus_plugin_services services {};
    tactus_plugin_setup setup {};
};

class CLayout
{
public:
    explicit CLayout (const DeviceLayout&);
    CLayout (const CLayout&) = delete;
    CLayout& operator= (const CLayout&) = delete;

    const tactus_plugin_layout* get() const noexcept { return &layout; }

private:
    std::vector<const char*> axes, efforts, buttons;
    tactus_plugin_mechanics mechanics;
    tactus_plugin_layout layout {};
};

/// A DeviceState as the hook `announce` gets it. The pointers to its values are valid as long as the DeviceState exists.
class ShownDevice
{
public:
    explicit ShownDevice (const DeviceState&);
    ShownDevice (const ShownDevice&) = delete;
    ShownDevice& operator= (const ShownDevice&) = delete;

    const tactus_plugin_device* get() const noexcept { return &device; }

private:
    CLayout layout;
    tactus_plugin_channels axes, signals, applied_axes, applied_signals;
    tactus_plugin_device device {};
};

/// Reads what the hook `effort` has filled in. [tick thread]
Effort readEffort (const tactus_plugin_effort&) noexcept;

}   // namespace tactus::plugin
