// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

namespace tactus
{

/// Compiled code that does in one call what the records of a plan do in one tick. It works on the same nodes and storage in the same order, and
/// gives the same bits. So a plan can switch between its records and this code between any two ticks, and no state moves.
struct FusedTick
{
    void (*tick) (void* const* objects) noexcept = nullptr;
    std::vector<void*> objects {};         ///< what `tick` works on; all of it belongs to the plan
    std::shared_ptr<const void> code {};   ///< keeps `tick` loaded
};

}   // namespace tactus
