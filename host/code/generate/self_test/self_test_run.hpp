// SPDX-License-Identifier: MIT
#pragma once

#include "self_test_code.hpp"

#include <tactus/run/run.hpp>

namespace tactus::host
{

/// Opens the devices that the graph describes. Those that are real are simulated.
Run::OpenDevice simulatedDevices();

/// Devices that replay the readings of this run's devices, from around the first effort that those get. Ticks the run.
Run::OpenDevice repeatedDevices (Run&);

/// Runs the graph with the engine of this program, turns its controls and parameters, hits its inputs, and keeps all inputs and outputs.
SelfTest selfTestOf (Run&, const Exported&);

}   // namespace tactus::host
