// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The stems of a graph: their names, their channels, and the taps of a run that they are made of.

#include "shadow_mixer.hpp"
#include "stems.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// A file before it is written.
struct Stem
{
    WrittenStem to {};
    std::vector<std::vector<float>> channels {};
    std::string role {};   ///< of the motor; "" if it is not known
};

/// The sum of taps, each times a number, as one channel of a file.
struct StemChannel
{
    std::size_t stem, channel;
    std::vector<std::pair<const Tap*, double>> from;
};

/// A layer of a mixer, as the channels of a file.
struct StemLayer
{
    std::size_t stem, mixer;   ///< mixer: number in StemPlan::mixers
    int layer;
};

/// The stems of a plan that taps stemPorts(). It must outlive this object.
struct StemPlan
{
    explicit StemPlan (const Plan&);

    std::vector<Stem> stems {};
    std::vector<StemChannel> channels {};
    std::vector<StemLayer> layers {};
    std::vector<ShadowMixer> mixers {};
};

/// The ports that a plan must tap.
std::vector<std::string> stemPorts (const plan::Flat&);

}   // namespace tactus::host
