// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "face.hpp"

#include <tactus/text/result.hpp>

namespace tactus::host
{

/// One end of a wire while it is being drawn: a port, and the quantity it carries if that is known.
struct WireEnd
{
    const FacePort* port;
    Quantity quantity;
};

/// Checks whether a wire from an output may end at a port. The error is short, such as "Length (m) cannot drive force (N)".
Result<> checkWire (const WireEnd& from, const WireEnd& to);

/// Like checkWire(), but also allows a vector at one end and a scalar at the other, because one component can be wired.
Result<> checkWireByComponent (const WireEnd& from, const WireEnd& to);

/// The SI unit of a quantity; "" if it has none.
Unit unitOf (Quantity) noexcept;

}   // namespace tactus::host
