// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/canvas/canvas.hpp>
#include <tactus/text/json.hpp>

namespace tactus::host
{

/// The positions of everything a script may want to click, in screen pixels: the nodes, ports, params and wires of a canvas, and all
/// named components of the window.
Json placesOf (juce::Component& window, const Canvas&);

}   // namespace tactus::host
