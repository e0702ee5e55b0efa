// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/flat/flat.hpp>

namespace tactus::plan
{

/// Reads the gain of a wire. Reports an error (wire/gain) and returns false if the gain is not a number.
bool readGain (const graph::Wire&, FlatWire&, Flat&);

/// True if the ends of a wire go together. If not, reports the first of these errors: wire/which_entry, wire/onto_choice,
/// wire/add_to_input, wire/width. unit_check checks the units.
bool wireFits (const FlatWire&, Flat&);

}   // namespace tactus::plan
