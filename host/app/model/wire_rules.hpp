// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "face.hpp"

#include <framework/text/result.hpp>

namespace tactus::host
{

/// One end of a wire while it is being drawn: a port, and the quantity it carries if that is known.
struct WireEnd
{
    const FacePort* port;
    Quantity quantity;
};

/// Checks whether a wire from an output may end at a port. The error is short, such as "m into N".
Result<> checkWire (const WireEnd& from, const WireEnd& to);

/// The same, but a single component may be wired if one end is a vector and the other is not.
Result<> checkWireByComponent (const WireEnd& from, const WireEnd& to);

/// True if several wires into one such input add up. Any other input takes one wire.
bool addsUp (Quantity) noexcept;

/// The SI unit of a quantity; "" if it has none.
Unit unitOf (Quantity) noexcept;

}   // namespace tactus::host
