// SPDX-License-Identifier: MIT
// The driver as a plugin.
#include "driver.hpp"

extern "C" const tactus_device_driver tactus_device_entry = tactus::host::evdev::driver;
