// SPDX-License-Identifier: MIT
#pragma once

#include "generic.hpp"

#include <tactus/kit/signal/mixing_desk.hpp>

#include <string>
#include <string_view>
#include <tuple>

namespace tactus
{

struct DeskSettings
{
    int inputs = 2;
    std::string names;
};

template <typename Layer>
struct DeskOutputs
{
    Layer out = Out<Layer> {}.out;
    List level;
    double reduction = 0.0;
};

/// The rows that the mixing desks have in common.
template <typename Inputs, typename Outputs>
constexpr auto deskPorts (std::string_view ceiling, std::string_view level)
{
    return std::tuple {
        input (&Inputs::in, "in", any_unit, "layers", 0.0),
        param (&DeskParams::gain, "gain", unit::gain, "factor on the layer with the same number", { .usual = { 0, 2 } }),
        param (&DeskParams::mute, "mute", unit::state, "on above 0.5: the layer is silent", { .hard = { 0, 1 } }),
        param (&DeskParams::solo, "solo", unit::state, "on above 0.5: only layers in solo are heard", { .hard = { 0, 1 } }),
        param (&DeskParams::priority, "priority", unit::count, "a layer is ducked while one of higher priority sounds", { .usual = { 0, 10 } }),
        param (&DeskParams::duck_db, "duck_db", unit::decibel, "attenuation of a ducked layer", { .hard = { 0, inf }, .usual = { 0, 60 } }),
        param (&DeskParams::ceiling, "ceiling", sameAs ("in"), ceiling, { .hard = { 0, inf }, .usual = { 0, 20 }, .off_at_zero = true }),
        inputCount (&DeskSettings::inputs, "number of layers"),
        setting (&DeskSettings::names, "names", unit::count, "labels of the layers, separated by commas"),
        output (&Outputs::out, "out", sameAs ("in"), "the mix"),
        output (&Outputs::level, "level", sameAs ("in"), level),
        output (&Outputs::reduction, "reduction", unit::decibel, "current attenuation by the ceiling"),
    };
}

}   // namespace tactus
