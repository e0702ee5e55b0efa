// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_device.h>

namespace tactus::host::falcon
{

/// The driver for the Novint Falcon. See docs/known_devices.md. The patient one is for tests: it waits longer for a Falcon that does not
/// answer, so a busy computer does not look like one.
extern const tactus_device_driver driver, patient_driver;

}   // namespace tactus::host::falcon
