// SPDX-License-Identifier: MIT
#include "plan.hpp"

namespace tactus
{

void Plan::forgetGraph()
{
    parts.flat = {};
    parts.exposed = {};
    std::vector<plan::Instance>().swap (parts.instances);
    parts.ramps = {};
    parts.takeover = {};
}

}   // namespace tactus
