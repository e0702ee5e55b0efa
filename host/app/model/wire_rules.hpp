// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "face.hpp"

#include <optional>
#include <string>

namespace tactus::host
{

/// One end of a wire that is being drawn: a port, and what it carries as far as is known.
struct WireEnd
{
    const FacePort* port;
    Quantity quantity;
};

/// Why a wire from an output cannot end there, in few words, as "m into N"; nothing if it can.
std::optional<std::string> whyNot (const WireEnd& from, const WireEnd& to);

/// The same if a single component of the vector may go, where one end is a vector and the other is not.
std::optional<std::string> whyNotByComponent (const WireEnd& from, const WireEnd& to);

/// Several wires into such an input add up; any other takes one.
bool addsUp (Quantity) noexcept;

/// The SI unit of a quantity; "" of one that has none of its own.
Unit unitOf (Quantity) noexcept;

}   // namespace tactus::host
