// SPDX-License-Identifier: MIT
#pragma once

/// Tells whether a plugin that another compiler has built can read a DeviceState of the host in place.

#include <tactus/node/device.hpp>

#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

namespace tactus::plugin
{

/// The standard library, as far as it determines how strings and vectors are laid out in memory; empty if that is not known.
inline std::string nameOfLibrary()
{
#if defined(_LIBCPP_ABI_VERSION)
    return "libc++ " + std::to_string (_LIBCPP_ABI_VERSION);
#elif defined(__GLIBCXX__)
    return "libstdc++ " + std::to_string (_GLIBCXX_USE_CXX11_ABI);
#elif defined(_MSVC_STL_VERSION)
    return "msvc " + std::to_string (_ITERATOR_DEBUG_LEVEL);
#else
    return {};
#endif
}

/// The layout of a DeviceState in memory: the library, the sizes of its parts, and the place of each member in the order of the C interface. If two
/// programs give the same text, and it is not empty, one can read the other's DeviceState in place.
inline std::string formOfDeviceState()
{
    auto text = nameOfLibrary();
    if (text.empty()) return {};
    for (const auto size : { sizeof (DeviceState), alignof (DeviceState), sizeof (Vec3), sizeof (Channels), sizeof (std::string),
                             sizeof (std::vector<std::string>) })
        text.append (" ").append (std::to_string (size));
    const DeviceState& s = no_device;
    const Reading& r = s.reading;
    for (const void* place : std::initializer_list<const void*> {
             &r.position, &r.rotation, &r.pressure, &r.age, &r.buttons, &r.fault, &r.valid, &r.true_position, &r.true_velocity, &r.unrendered_force,
             &r.unrendered_torque, r.axes.used(), r.axes.begin(), r.signals.used(), r.signals.begin(), &s.applied.force, &s.applied.torque,
             s.applied.axes.used(), s.applied.axes.begin(), s.applied.signals.used(), s.applied.signals.begin(), &s.layout.axes, &s.layout.efforts,
             &s.layout.buttons, &s.layout.signal_inputs, &s.layout.signal_outputs, &s.layout.mechanics.mass, &s.layout.mechanics.damping,
             &s.applied.brake, &s.layout.brake })
        text.append (" ").append (std::to_string (static_cast<const std::byte*> (place) - reinterpret_cast<const std::byte*> (&s)));
    return text;
}

}   // namespace tactus::plugin
