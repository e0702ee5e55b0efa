// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/node/catalogue.hpp>
#include <tactus/text/result.hpp>

#include <string>

#include <juce_core/juce_core.h>

namespace tactus::host
{

/// The property of a component that shows a control: the control's id.
inline const juce::Identifier shown_control { "control" };

/// The datasheet row of the value of a control, from 0 to 1.
const PortSheet& controlSheet();

/// Reads the value of a control as a person types it: "0.35" or "35 %". Id: control/value.
Result<double> readControl (const std::string&);

}   // namespace tactus::host
