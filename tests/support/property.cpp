// SPDX-License-Identifier: MIT
#include "property.hpp"

#include <rapidcheck/catch.h>

namespace tactus::test
{
void property (const std::string& name, const std::function<void()>& body) { rc::prop (name, body); }
}   // namespace tactus::test
