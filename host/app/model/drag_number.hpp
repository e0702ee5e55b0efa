// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "face.hpp"
#include "quantity_text.hpp"

namespace tactus::host
{

/// True if dragging scales the value instead of adding to it: the usual range spans two decades or more.
bool isLogarithmic (const PortSheet&) noexcept;

/// The datasheet row of a param as it is dragged. If its unit follows from the wires, so does its usual range: it is as wide as that of the param at the
/// end of the wires. Infinite if this has none, or if the value has a unit and there is no wire: then a drag is relative to the value.
PortSheet sheetInUse (const graph::Graph&, const graph::Patch&, const graph::Node&, const FacePort&, const Json& now, const Catalogue&);

/// The value after dragging up by this many pixels: 200 pixels cover the usual range. Clamped to the hard range.
QuantityText dragged (const QuantityText& from, const PortSheet&, double pixels);

}   // namespace tactus::host
