// SPDX-License-Identifier: MIT
// Devices for the guest: guest_device board|space_mouse|joystick|wheel|dualsense|switch_pro [--option VALUE]…
#include "uhid.hpp"

int main (int argc, char** argv)
{
    using namespace tactus::guest;
    const std::vector<std::string> args (argv + 1, argv + argc);
    const std::string what = args.empty() ? "" : args.front();
    if (what == "board") return board (args);
    if (what == "space_mouse") return spaceMouse (args);
    if (what == "joystick") return joystick (args);
    if (what == "wheel") return wheel (args);
    if (what == "dualsense") return dualSense (args);
    if (what == "switch_pro") return switchPro (args);
    std::fprintf (stderr, "usage: guest_device board|space_mouse|joystick|wheel|dualsense|switch_pro [--option VALUE]...\n");
    return 2;
}
