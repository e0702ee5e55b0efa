// SPDX-License-Identifier: MIT
#include "plan.hpp"

namespace tactus
{

void Plan::forgetGraph()
{
    parts.flat = {};
    parts.exposed = std::make_shared<std::map<std::string, std::vector<plan::PortRef>>>();
    parts.instances = {};
    parts.ramps = {};
    parts.takeover = {};
    parts.background = nullptr;
    parts.wire_ends = {};
}

}   // namespace tactus
