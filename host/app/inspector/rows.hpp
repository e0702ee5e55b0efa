// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "block.hpp"

#include <host/app/model/document.hpp>
#include <host/app/model/face.hpp>

#include <functional>
#include <optional>

namespace tactus::host
{

/// A word on why something was not taken.
using Refusal = std::function<void (const juce::String&)>;

/// A param of a node: a field for each component, or a list of choices. One that a control sets moves that control; its menu
/// gives it to one, or takes it away.
std::unique_ptr<Block> paramRow (Document&, const std::string& patch, const std::string& node, const FacePort&, const Refusal&);

/// What the menu of a param does. "" is a new control.
void controlBy (Document&, const std::string& node, const FacePort&, const std::string& control);
void release (Document&, const std::string& node, const FacePort&);

/// A control of the graph: its name, a fader, and what it moves from where to where.
std::unique_ptr<Block> controlEditor (Document&, const Catalogue&, const std::string& id, const Refusal&);

}   // namespace tactus::host
