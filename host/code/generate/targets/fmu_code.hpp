// SPDX-License-Identifier: MIT
#pragma once

#include <host/code/generate/class/exported.hpp>

#include <string>

namespace tactus::host
{

/// A graph as a unit for co-simulation, by the Functional Mock-up Interface 2.0: its description, the functions that a simulator calls,
/// and the rules that build it.
struct FmuFiles
{
    std::string description, source, make;
};

FmuFiles fmuFiles (const Exported&);

/// Our own declarations of the interface, from the standard.
const char* fmiHeader();

}   // namespace tactus::host
