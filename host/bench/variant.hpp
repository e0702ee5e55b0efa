// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace tactus::bench
{

/// One of several ways to compute the same thing.
class Variant
{
public:
    virtual ~Variant() = default;

    virtual void tick (const double* in) noexcept = 0;

    /// The outputs of the last tick.
    virtual std::vector<double> outputs() const = 0;
};

}   // namespace tactus::bench
