// SPDX-License-Identifier: MIT
// The driver as a plugin.
#include "touch.hpp"

extern "C" const tactus_device_driver tactus_device_entry = tactus::host::openhaptics::driver;
