// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tactus::bench
{

/// What a plan takes of the heap for each of its nodes beyond the node's own struct, in bytes, the allocator's part
/// included.
struct Memory
{
    double to_tick = 0.0;   ///< outputs, records, pointers: what the tick reads and writes
    double to_edit = 0.0;   ///< the graph as it was compiled, and knobs: for turning them, and for the plan after this one
};

/// Of a chain of ten thousand one-poles.
Memory memoryPerNode();

}   // namespace tactus::bench
