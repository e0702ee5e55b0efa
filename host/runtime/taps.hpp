// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "triggered_capture.hpp"

#include <framework/message.hpp>

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace tactus::host
{

/// The numbers of the taps that are parts of one of these ports.
std::vector<std::size_t> tapsOf (const Plan&, const std::vector<std::string>& ports);

std::vector<std::string> namesOf (const Plan&, const std::vector<std::size_t>& taps);

/// What takes down a port around an edge of another one, and the names of its components.
struct Armed
{
    std::unique_ptr<TriggeredCapture> capture;
    std::vector<std::string> components;
};

/// Both ports are among the taps of the plan, or it says that they are not. Ids: probe/trigger, probe/too_many.
std::variant<Armed, Message> arm (const Plan&, const std::string& port, const std::string& watched, const Trigger&);

}   // namespace tactus::host
