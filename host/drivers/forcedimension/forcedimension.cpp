// SPDX-License-Identifier: MIT
// The driver as a plugin.
#include "arm.hpp"

extern "C" const tactus_device_driver tactus_device_entry = tactus::host::forcedimension::driver;
