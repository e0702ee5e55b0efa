// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/signal/clip.hpp>
#include <tactus/text/message.hpp>

#include <string_view>

namespace tactus::readers
{

/// The weight with which a channel is added to others where a format has only one channel. It is a note of the clip, since nothing else uses it; 1 without a
/// note.
inline constexpr double heaviest_mixing = 1e4;
bool isMixingNote (std::string_view key);
double mixingWeight (const Clip&, int channel);
void setMixingWeight (Clip&, int channel, double weight);

/// The clip with its channels ready to be added up: each times its weight, without the notes of weights. Losses beyond that are named.
Clip weighted (Clip, Messages& losses);

}   // namespace tactus::readers
