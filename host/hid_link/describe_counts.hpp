// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid_link/hid_device.hpp>

#include <string>

namespace tactus::host::hid
{

/// "5000 taken, 12 lost, 3 refused (2 too short, 1 wrong mark), 5 skipped"
std::string describe (const ReadingCounts&, const PortCounts&);

}   // namespace tactus::host::hid
