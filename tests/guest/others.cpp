// SPDX-License-Identifier: MIT
#include "uhid.hpp"

namespace tactus::guest
{

/// A SpaceMouse: position in report 1, rotation in report 2, buttons in report 3, a lamp in output report 4. It is held
/// at x 100 and rz -50 counts, with the first button down. --seconds S
int spaceMouse (const std::vector<std::string>& args)
{
    // Multi-axis controller (usage 0x08 of the generic desktop).
    constexpr std::uint8_t descriptor[] { 0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0xa1, 0x00, 0x85, 0x01, 0x16, 0xa2, 0xfe, 0x26, 0x5e, 0x01, 0x09, 0x30, 0x09,
                                          0x31, 0x09, 0x32, 0x75, 0x10, 0x95, 0x03, 0x81, 0x02, 0xc0, 0xa1, 0x00, 0x85, 0x02, 0x09, 0x33, 0x09, 0x34, 0x09,
                                          0x35, 0x75, 0x10, 0x95, 0x03, 0x81, 0x02, 0xc0, 0xa1, 0x02, 0x85, 0x03, 0x05, 0x09, 0x19, 0x01, 0x29, 0x10, 0x15,
                                          0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x10, 0x81, 0x02, 0xc0, 0xa1, 0x02, 0x85, 0x04, 0x05, 0x08, 0x09, 0x4b, 0x15,
                                          0x00, 0x25, 0x01, 0x95, 0x01, 0x75, 0x01, 0x91, 0x02, 0x95, 0x01, 0x75, 0x07, 0x91, 0x03, 0xc0, 0xc0 };
    Uhid device ("Test SpaceMouse", "", 0x256f, 0xc635, descriptor);   // the kernel has its own drivers for other models
    const double end = now() + option (args, "seconds", 10.0);
    const auto two = [] (int v) { return std::array { static_cast<std::uint8_t> (v), static_cast<std::uint8_t> (v >> 8) }; };
    for (double due = now(); now() < end; due += 0.016)
    {
        device.serve (due, [] (auto) {});
        if (! device.isOpen()) continue;
        const auto x = two (100), rz = two (-50);
        device.input (std::array<std::uint8_t, 7> { 1, x[0], x[1], 0, 0, 0, 0 });
        device.input (std::array<std::uint8_t, 7> { 2, 0, 0, 0, 0, rz[0], rz[1] });
        device.input (std::array<std::uint8_t, 3> { 3, 1, 0 });
    }
    return 0;
}

}   // namespace tactus::guest
