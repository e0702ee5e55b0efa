// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "controlled_param.hpp"
#include "face.hpp"
#include "patch.hpp"

#include <optional>

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

/// What a control sets its parameter to now, in the unit its low end is written in.
Json valueOf (const ControlledParam&, const PortSheet&);

/// Gives a param this value, or its default if there is none. Moves the control that drives it; empty if the value is out of
/// that control's range.
std::optional<graph::Command> changeParam (const graph::Graph&, const SeenPatch&, const graph::Node&, const FacePort&, const std::optional<Json>& value);

/// Explains to the user why changeParam() returned nothing.
std::string outOfRangeText (const graph::Graph&, const SeenPatch&, const graph::Node&, const FacePort&);

}   // namespace tactus::host
