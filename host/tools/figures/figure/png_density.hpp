// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace tactus::host
{

/// Adds the number of pixels per inch to a PNG that states none, so that programs know its size on paper (chunk pHYs, PNG specification, 11.3.5.3).
std::string withDensity (std::string png, double dpi);

}   // namespace tactus::host
