// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "face.hpp"
#include "held.hpp"

#include <optional>

namespace tactus::host
{

/// What a param is now: as it is written, or its default, or what a control of the graph makes of it.
struct ParamNow
{
    Json value;
    bool is_set = false;        ///< it is not the default
    std::optional<Held> held;   ///< by a control, which has to be moved instead
};

ParamNow paramNow (const graph::Graph&, const std::string& patch, const graph::Node&, const FacePort&);

/// What gives a param that value; without one, its default. A control that holds it is moved; nothing if it does not reach
/// so far.
std::optional<graph::Command> changeParam (const graph::Graph&, const std::string& patch, const graph::Node&, const FacePort&, const std::optional<Json>& value);

/// Why that is, in words.
std::string beyondReach (const graph::Graph&, const graph::Node&, const FacePort&);

}   // namespace tactus::host
