// SPDX-License-Identifier: MIT
#pragma once

#include "triggered_capture.hpp"

#include <tactus/text/result.hpp>

#include <memory>
#include <string>

#include <vector>

namespace tactus
{

/// The numbers of the taps that belong to one of these ports.
std::vector<std::size_t> tapsOf (const Plan&, const std::vector<std::string>& ports);

std::vector<std::string> namesOf (const Plan&, const std::vector<std::size_t>& taps);

/// A capture of a port around an edge of another port, and the names of the captured components.
struct Armed
{
    std::unique_ptr<TriggeredCapture> capture;
    std::vector<std::string> components;
};

/// Fails if the watched port does not have exactly one tap in the plan, or if the capture would be too large. Ids: probe/trigger, probe/too_many.
Result<Armed> arm (const Plan&, const std::string& port, const std::string& watched, const Trigger&);

}   // namespace tactus
