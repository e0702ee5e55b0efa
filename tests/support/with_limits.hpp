// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/budget.hpp>

/// Changes budgets, as --limits does, until the end of a test.
class WithLimits
{
public:
    explicit WithLimits (std::string_view limits) { tactus::setBudgets (tactus::readLimits (limits).value()); }
    ~WithLimits() { tactus::setBudgets ({}); }
    WithLimits (const WithLimits&) = delete;
    WithLimits& operator= (const WithLimits&) = delete;
};
