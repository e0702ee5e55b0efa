// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "controlled_param.hpp"
#include "face.hpp"
#include "patch.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// The current value of a param: the stored value, its default, or what a control of the graph sets it to.
struct ParamNow
{
    Json value;
    bool is_set = false;                      ///< true if the value is not the default
    std::optional<ControlledParam> control;   ///< set if a control drives the param; an edit then has to move that control
};

ParamNow paramNow (const graph::Graph&, const SeenPatch&, const graph::Node&, const FacePort&);

/// The wire that sets a param, or one component of it, whatever value is stored. Null if none does. A wire that adds to the value does not set it.
const graph::Wire* driverOf (const graph::Patch&, const std::string& node, const FacePort& param, int component = -1);

/// The gain of a wire as it is written: "8 mN", "0.5".
juce::String gainText (const Json&);

/// The wires that add to the value of a param, and by how much for each unit of their source: "8 mN x lfo.out". Empty if none does.
juce::String addedTo (const graph::Patch&, const std::string& node, const FacePort& param);

/// True if a wire sets the param of a node, or a component of it.
bool drives (const graph::Wire&, const FacePort& param);

/// The params of a patch that wires outside of it set, through ports that its subgraph exposes or by their path, such as "drag.mu", each with the output
/// where its wire begins, as seen from the graph itself. None if one has not entered the patch.
std::map<std::string, std::string> drivenFromOutside (const graph::Graph&, const SeenPatch&);

/// The output whose wire sets a param, or one component of it: "level.out". Empty if none does.
std::string driverName (const graph::Graph&, const SeenPatch&, const std::string& node, const FacePort& param, int component = -1);

/// The same for a path such as "grain/drag.mu".
std::string driverAt (const graph::Graph&, const std::string& path);

/// By target of a control: the output whose wire sets it, so that the control has no effect on it. Empty if none does.
std::vector<std::string> driversOf (const graph::Graph&, const graph::Control&);

/// True if wires set all targets of a control, which has some: it has no effect.
bool isOverridden (const graph::Graph&, const graph::Control&);

/// Tells the user which targets of a control a wire sets. Empty if none.
juce::String overriddenText (const graph::Graph&, const graph::Control&);

/// Explains to the user why the value of a param cannot be set: a wire from this output sets it.
juce::String drivenText (const std::string& output);

/// The value to which a control sets its parameter now, in the unit in which its low end is written.
Json valueOf (const ControlledParam&, const PortSheet&);

/// Gives a param this value, or its default if there is none. Moves the control that drives it; empty if the value is out of
/// that control's range.
std::optional<graph::Command> changeParam (const graph::Graph&, const SeenPatch&, const graph::Node&, const FacePort&, const std::optional<Json>& value);

/// Explains to the user why changeParam() returned nothing.
std::string outOfRangeText (const graph::Graph&, const SeenPatch&, const graph::Node&, const FacePort&);

}   // namespace tactus::host
