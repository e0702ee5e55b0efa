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

/// A param of a node: a field for each component, or a list of choices.
std::unique_ptr<Block> paramRow (Document&, const std::string& patch, const std::string& node, const FacePort&, const Refusal&);

/// A setting of a node, as a file has it.
std::unique_ptr<Block> settingRow (Document&, const std::string& patch, const std::string& node, const SettingSheet&);

/// A control of the graph, as a fader.
std::unique_ptr<Block> controlRow (Document&, const std::string& id);

}   // namespace tactus::host
