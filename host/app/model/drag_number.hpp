// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quantity_text.hpp"

namespace tactus::host
{

/// True if dragging scales the value instead of adding to it: the usual range spans two decades or more.
bool isLogarithmic (const PortSheet&) noexcept;

/// The value after dragging up by this many pixels: 200 pixels cover the usual range. Clamped to the hard range.
QuantityText dragged (const QuantityText& from, const PortSheet&, double pixels);

}   // namespace tactus::host
