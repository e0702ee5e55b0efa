// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>

namespace tactus::plugin
{

/// Held during each call of a [main thread] function of a plugin. The interface promises plugins that such calls never overlap, but
/// graphs are compiled on several threads: the window checks limits and draws presets in the background. One lock for all plugins,
/// because one file may be loaded more than once. [any thread but the tick thread]
inline std::unique_lock<std::mutex> hookTurn()
{
    static std::mutex turn;
    return std::unique_lock { turn };
}

}   // namespace tactus::plugin
