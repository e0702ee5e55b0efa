// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace tactus::host
{

class Canvas;

/// A canvas command with a menu item, a keyboard shortcut, or both.
struct CanvasCommand
{
    const char* name;                       ///< menu text, in English
    const char* keys;                       ///< juce::KeyPress descriptions, separated by '|'; "" for none
    bool (*can) (const Canvas&) noexcept;   ///< false if the command does not apply to the selection
    void (*run) (Canvas&);
    bool ends_group = false;   ///< a separator follows in the menu
    bool in_menu = true;       ///< false: keyboard only
};

std::span<const CanvasCommand> canvasCommands() noexcept;

}   // namespace tactus::host
