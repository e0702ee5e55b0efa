// SPDX-License-Identifier: MIT
#pragma once

#include "node_dice.hpp"
#include "rig.hpp"

#include <sstream>
#include <string>
#include <vector>

/// The functions that examination.cpp lists. Each file examines one kind of promise.
namespace tactus::examine
{

using Fault = std::string (const NodeType&, unsigned seed);
using Reason = std::string (const NodeType&);

Fault hookFault, sheetFault;                                 // hooks.cpp, sheet.cpp
Fault rangeFault, sizeFault;                                 // finite.cpp
Fault nanFault, revivalFault, memoryFault;                   // nan.cpp
Fault repeatFault, instanceFault, threadFault, adoptFault;   // same_bits.cpp
Fault stateFault;                                            // same_bits.cpp
Fault allocationFault, lockFault, systemCallFault;           // real_time.cpp, system_calls.cpp
Fault amplitudeFault, passiveFault;                          // claims.cpp
Reason noInputs, peeks, noAdopt, noState, unwatched, callsUnwatched, noClaims, notMechanical;

/// A node as it is before its first tick, with its defaults.
inline Rig prepared (const NodeType& type, double rate_hz = 4000.0)
{
    Rig rig { type, rate_hz };
    rig.prepare();
    return rig;
}

/// True if all bits are the same, including the sign of a zero and the bits of a nan.
bool sameBits (const std::vector<double>& a, const std::vector<double>& b);

/// Text for a message: all parts one after another.
template <typename... T>
std::string say (const T&... parts)
{
    std::ostringstream text;
    (text << ... << parts);
    return text.str();
}

}   // namespace tactus::examine
