// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "kernels.hpp"
#include "variant.hpp"

namespace tactus::bench
{

/// The reference graph as one would write it without a framework: the kernels called one after another, values passed
/// in local variables, sums and products where they are needed.
class ByHand : public Variant
{
public:
    ByHand() : k (device) {}

    void tick (const double* in) noexcept override;
    std::vector<double> outputs() const override;

private:
    DeviceState device;
    Kernels k;
};

}   // namespace tactus::bench
