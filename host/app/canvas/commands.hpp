// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace tactus::host
{

class Canvas;

/// Something that can be done on a canvas, by a key or from its menu.
struct CanvasCommand
{
    const char* name;                       ///< as in the menu
    const char* keys;                       ///< as juce::KeyPress describes them, several separated by '|'; "" for none
    bool (*can) (const Canvas&) noexcept;   ///< whether there is anything to do it with
    void (*run) (Canvas&);
    bool ends_group = false;   ///< a line follows in the menu
    bool in_menu = true;       ///< else it is for the keys alone
};

std::span<const CanvasCommand> canvasCommands() noexcept;

}   // namespace tactus::host
