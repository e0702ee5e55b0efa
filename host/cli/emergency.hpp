// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/engine.hpp>
#include <host/platform/terminal.hpp>

namespace tactus::host
{

/// The emergency stop of a run, within reach while this lives: the space bar presses it and R ends it, in a terminal; SIGUSR1
/// and SIGUSR2 do from anywhere. One at a time. [main thread]
class Emergency
{
public:
    /// The engine outlives it.
    explicit Emergency (Engine&);
    ~Emergency();
    Emergency (const Emergency&) = delete;
    Emergency& operator= (const Emergency&) = delete;

    bool hasKeys() const noexcept { return keys.areThere(); }

    /// Heeds the keys that were pressed. To be called many times a second.
    void attend();

private:
    Engine& engine;
    Keys keys;
};

}   // namespace tactus::host
