// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tactus::bench
{

/// The heap memory, in bytes, that a plan uses for each node in addition to the node's own struct. Includes the allocator's overhead.
struct Memory
{
    double to_tick = 0.0;   ///< memory that a tick reads and writes: outputs, records, pointers
    double to_edit = 0.0;   ///< memory for turning knobs and for compiling the next plan: the compiled graph, and the knobs
};

/// Measured on a chain of ten thousand one-poles.
Memory memoryPerNode();

}   // namespace tactus::bench
