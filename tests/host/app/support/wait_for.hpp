// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "window_rig.hpp"

namespace tactus::host::test
{

/// Lets the window work until something is so. False if it still is not after half a minute.
template <typename F>
bool waitFor (F&& isSo)
{
    for (int i = 0; i < 3000 && ! isSo(); ++i)
        WindowRig::settle (10);
    return isSo();
}

}   // namespace tactus::host::test
