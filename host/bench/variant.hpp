// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace tactus::bench
{

/// One of several ways to work out the same thing.
class Variant
{
public:
    virtual ~Variant() = default;

    virtual void tick (const double* in) noexcept = 0;

    /// What the last tick gave.
    virtual std::vector<double> outputs() const = 0;
};

}   // namespace tactus::bench
