// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/inspector/blocks/block.hpp>
#include <host/app/model/document.hpp>
#include <host/app/model/face.hpp>
#include <host/app/model/patch.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace tactus::host
{

/// Tells the user why an edit was refused.
using Refusal = std::function<void (const juce::String&)>;

/// A function that returns the value of a param in the run, in SI, by component. Empty if nothing runs, or if it is not known.
using LiveValues = std::function<std::vector<double> (const std::string& param)>;

/// A param of a node: a field per component, or a list of choices. If a control drives it, editing moves the control. If a wire sets it, its
/// value is that of the run, and the source is named. `fillMenu` fills its menu.
std::unique_ptr<Block> paramRow (Document&, const Catalogue&, const SeenPatch&, const std::string& node, const FacePort&, const Refusal&, LiveValues,
                                 std::function<void (juce::PopupMenu&)> fillMenu);

/// controlBy() assigns a param to a control; "" creates a new one. release() ends that. Both keep the current value of the param, so
/// controlBy() returns false where the instances of a subgraph have different ones.
bool controlBy (Document&, const SeenPatch&, const std::string& node, const FacePort&, const std::string& control, const Catalogue&);
void release (Document&, const SeenPatch&, const std::string& node, const FacePort&, const Catalogue&);

/// A control of the graph: its name, a fader, and its targets with their ranges.
std::unique_ptr<Block> controlEditor (Document&, const Catalogue&, const std::string& id, const Refusal&);

}   // namespace tactus::host
