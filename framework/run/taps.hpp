// SPDX-License-Identifier: MIT
#pragma once

#include "triggered_capture.hpp"

#include <framework/text/result.hpp>

#include <memory>
#include <string>

#include <vector>

namespace tactus
{

/// The numbers of the taps that belong to one of these ports.
std::vector<std::size_t> tapsOf (const Plan&, const std::vector<std::string>& ports);

std::vector<std::string> namesOf (const Plan&, const std::vector<std::size_t>& taps);

/// A capture of a port around an edge of another one, and the names of its components.
struct Armed
{
    std::unique_ptr<TriggeredCapture> capture;
    std::vector<std::string> components;
};

/// Fails if a port is not among the taps of the plan. Ids: probe/trigger, probe/too_many.
Result<Armed> arm (const Plan&, const std::string& port, const std::string& watched, const Trigger&);

}   // namespace tactus
