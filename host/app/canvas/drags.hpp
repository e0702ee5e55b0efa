// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "canvas.hpp"

namespace tactus::host
{

std::unique_ptr<Drag> panBy (Canvas&, const juce::MouseEvent&);

/// Box selection. With shift or command it extends the selection.
std::unique_ptr<Drag> lasso (Canvas&, const juce::MouseEvent&);

/// Moves the selection, on the grid unless alt is held. A single node dropped on a wire is inserted into it.
std::unique_ptr<Drag> moveSelection (Canvas&, const juce::MouseEvent&);

/// Draws a wire from a port, in either direction.
std::unique_ptr<Drag> drawWire (Canvas&, PortId);

/// Moves the end of a wire from an input to another one, or removes the wire if dropped on empty canvas. Null if the input has no wire.
std::unique_ptr<Drag> replugWire (Canvas&, const SceneNode&, const FacePort&);

/// Changes a param by dragging up and down. Null if the param is not a single number.
std::unique_ptr<Drag> dragParam (Canvas&, const SceneNode&, const Socket&);

/// Moves a bend of a wire, on the grid unless alt is held. The move of a new bend belongs to the step that made it.
std::unique_ptr<Drag> moveBend (Canvas&, const Bend&, bool is_new);

std::unique_ptr<Drag> resizeNote (Canvas&, const juce::MouseEvent&, std::size_t note);
std::unique_ptr<Drag> panByMap (Canvas&, const juce::MouseEvent&);

}   // namespace tactus::host
