// SPDX-License-Identifier: MIT
#include "device_numbers.hpp"

#include <algorithm>
#include <limits>

namespace tactus
{

std::span<const DeviceNumberRow> deviceNumberRows() noexcept
{
    using D = DeviceNumbers;
    static constexpr DeviceNumberRow rows[] {
        { "mass", unit::kilogram, Bounds::positive(), &D::mass },
        { "damping", unit::damping, Bounds::notNegative(), &D::damping },
        { "coulomb", unit::newton, Bounds::notNegative(), &D::coulomb },
        { "quantum", unit::metre, Bounds::notNegative(), &D::quantum },
        { "force_quantum", unit::newton, Bounds::notNegative(), &D::force_quantum },
        { "delay", unit::count, { .min = 0.0, .max = longest_delay }, &D::delay, true },
        { "first_mode", unit::hertz, { .min = 0.0, .max = highest_first_mode, .without_min = true }, &D::first_mode },
        { "first_mode_damping", unit::gain, { .min = 0.0, .max = 1.0 }, &D::first_mode_damping },
        { "end_mass", unit::kilogram, Bounds::positive(), &D::end_mass },
        { "peak_force", unit::newton, Bounds::positive(), &D::peak_force, false, false },
        { "rate", unit::hertz, Bounds::positive(), &D::rate, false, false },
    };
    return rows;
}

bool isEmpty (const DeviceNumbers& numbers)
{
    return ! numbers.workspace && std::ranges::none_of (deviceNumberRows(), [&] (const auto& row) { return (numbers.*row.member).has_value(); });
}

DeviceNumbers numbersOf (const Simulation& sim, const GuardLimits& guard)
{
    const auto given = [] (double value) { return DeviceNumber { .value = value, .source = "the description of the simulated device" }; };
    DeviceNumbers n;
    n.mass = given (sim.mass);
    n.damping = given (sim.damping);
    n.coulomb = given (sim.coulomb);
    n.quantum = given (sim.quantum);
    n.force_quantum = given (sim.force_quantum);
    n.delay = given (sim.delay);
    const bool is_rigid = sim.first_mode == 0.0;
    n.first_mode = given (is_rigid ? std::numeric_limits<double>::infinity() : sim.first_mode);
    if (! is_rigid)
    {
        n.first_mode_damping = given (sim.first_mode_damping);
        n.end_mass = given (endMassOf (sim));
    }
    if (guard.max_force != GuardLimits::none) n.peak_force = DeviceNumber { .value = guard.max_force, .source = "max_force of the device's guard" };
    return n;
}

}   // namespace tactus
