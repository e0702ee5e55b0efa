// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "window_parts.hpp"

namespace tactus::host
{

/// The ways to begin: the welcome page, the templates on an empty canvas, the tour, and the hand with which an opened graph starts. [main thread]
class Beginnings
{
public:
    explicit Beginnings (WindowParts&);

    void showWelcome();
    void poll();             ///< call many times a second
    void placeTemplates();   ///< shows them if the graph is empty; call it when the canvas has moved, and after each edit

    /// Opens a preset or template as a copy, to be felt by the mouse or by its own hand.
    void feel (const std::filesystem::path& preset, bool by_pointer);

    /// Runs the graph that has just been opened. The mouse or the gesture that the user has chosen goes on to the next graph. A device does only if the
    /// session binds it to a role of that name, and not after a person has stopped it: then only START does.
    void run (bool by_pointer);

    void stop();   ///< before another graph is opened

    void tour();   ///< if nothing is open, with a preset to feel

private:
    void noteStops();
    bool waitsForStart() const;   ///< a device of the session moves the tool, and a person has stopped it

    WindowParts& parts;
    bool was_stopped = false;      // by a person, before the graph was opened
    std::uint32_t own_stops = 1;   // personStops() after stop(), which counts as one; it begins at 1
};

}   // namespace tactus::host
