// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/plan.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace tactus::host
{

/// Finds the outputs and parameters of a plan's nodes by address.
class PlanAddresses
{
public:
    explicit PlanAddresses (const Plan&);

    /// One component of a port.
    struct Found
    {
        std::size_t instance;
        const PortSheet* sheet;
        int slot;
    };

    std::optional<Found> outputAt (const double*) const;
    std::optional<Found> paramAt (const double*) const;

private:
    /// The number of an instance, by the address where its struct begins.
    using Starts = std::map<const std::byte*, std::size_t>;

    std::optional<Found> find (const double*, const Starts&, std::vector<PortSheet> NodeType::*rows, std::size_t NodeType::*size) const;

    const Plan& plan;
    Starts outputs, params;
};

}   // namespace tactus::host
