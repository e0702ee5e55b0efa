// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quantity_text.hpp"

namespace tactus::host
{

/// True if a param is turned by factors rather than by differences: its usual range spans two decades or more.
bool isLogarithmic (const PortSheet&) noexcept;

/// Where a number gets to that is dragged up by so many pixels: over its usual range in 200. Within its hard range.
QuantityText dragged (const QuantityText& from, const PortSheet&, double pixels);

}   // namespace tactus::host
