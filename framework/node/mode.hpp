// SPDX-License-Identifier: MIT
#pragma once

#include "datasheet.hpp"

#include <tuple>

namespace tactus
{

/// One decaying tone of a struck object, a e^(-decay t) sin (2 pi frequency t), as in the settings of nodes that ring.
struct Mode
{
    double frequency = 200.0;
    double decay = 60.0;
    double amplitude = 0.5;

    bool operator== (const Mode&) const = default;

    static constexpr std::tuple fields {
        field (&Mode::frequency, "frequency", unit::hertz, "frequency of the mode", { .hard = { 0, inf }, .usual = { 10, 2000 } }),
        field (&Mode::decay, "decay", unit::per_second, "decay rate; 1 / decay is the time constant", { .hard = { 0, inf }, .usual = { 1, 500 } }),
        field (&Mode::amplitude, "amplitude", Unit { Quantity::any, { 0, 1, -1 }, "N*s/m" }, "force per impact speed", { .usual = { 0, 10 } }),
    };
};

}   // namespace tactus
