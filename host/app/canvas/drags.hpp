// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "canvas.hpp"

namespace tactus::host
{

std::unique_ptr<Drag> panBy (Canvas&, const juce::MouseEvent&);

/// Selects what a rectangle touches; with shift or command held, besides what is selected.
std::unique_ptr<Drag> lasso (Canvas&, const juce::MouseEvent&);

/// Moves what is selected, on the grid unless alt is held. One node that is let go on a wire goes into it.
std::unique_ptr<Drag> moveSelection (Canvas&, const juce::MouseEvent&);

/// Draws a wire from a port, whichever end it is.
std::unique_ptr<Drag> drawWire (Canvas&, WireStart);

/// Takes the wire that ends at an input to another one, or off, if it is let go on nothing. Null if none ends there.
std::unique_ptr<Drag> replugWire (Canvas&, const SceneNode&, const FacePort&);

/// Turns a param up and down. Null if it is none that can be turned.
std::unique_ptr<Drag> turnParam (Canvas&, const SceneNode&, const Socket&);

std::unique_ptr<Drag> resizeNote (Canvas&, const juce::MouseEvent&, std::size_t note);
std::unique_ptr<Drag> panByMap (Canvas&, const juce::MouseEvent&);

}   // namespace tactus::host
