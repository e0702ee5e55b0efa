// SPDX-License-Identifier: MIT
// The driver as a plugin.
#include "inverse3.hpp"

extern "C" const tactus_device_driver tactus_device_entry = tactus::host::haply_driver;
