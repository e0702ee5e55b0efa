// SPDX-License-Identifier: MIT
#pragma once

#include "../rapidcheck.h"

#include <catch2/catch.hpp>

namespace rc
{
template <typename Body>
void prop (const std::string& name, const Body& body)
{
    SECTION (name)
    {
        const auto why = whyNot (body);
        if (! why.empty()) FAIL (name << ": " << why);
    }
}
}   // namespace rc
