// SPDX-License-Identifier: MIT
#pragma once

#include "node_dice.hpp"

#include <limits>

namespace tactus::examine
{

/// Ticks a node while its params move; on one tick, an input is nan. Calls `before` before each tick, and `after` after it.
template <typename Before, typename After>
void tickWatched (Rig& rig, NodeDice& dice, Before&& before, After&& after)
{
    for (int k = 0; k < 200; ++k)
    {
        if (k % 20 == 0) randomParams (rig, dice, Span::usual);
        randomTameInputs (rig, dice);
        if (k == 100 && ! rig.in.empty()) rig.in[0] = std::numeric_limits<double>::quiet_NaN();
        rig.moved();
        before();
        rig.tick();
        rig.effort();
        after();
    }
}

}   // namespace tactus::examine
