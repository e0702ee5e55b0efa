// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/canvas/canvas.hpp>

#include <framework/json.hpp>

namespace tactus::host
{

/// Where everything is on the screen that a script may want to click on: nodes, ports, params and wires of a canvas by their
/// names, and whatever in the window has a name, in pixels of the screen.
Json placesOf (juce::Component& window, const Canvas&);

}   // namespace tactus::host
