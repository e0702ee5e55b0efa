// SPDX-License-Identifier: MIT
// The weights with which the channels of an HJIF are added up. MPEG's own software plays each channel by itself, at its gain, and only stores the weight,
// for players with one actuator for several channels.
#include "clip_mixing.hpp"
#include "clip_formats.hpp"

#include <tactus/text/number_text.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <set>

namespace tactus::readers
{

namespace
{
constexpr std::string_view prefix = "mixing weight of channel ";

std::string noteOf (int channel) { return std::string (prefix) + std::to_string (channel); }
}   // namespace

bool isMixingNote (std::string_view key) { return key.starts_with (prefix); }

double mixingWeight (const Clip& clip, int channel)
{
    const auto key = noteOf (channel);
    for (const auto& [name, value] : clip.notes)
        if (name == key)
            if (const double weight = readNumber (value).value; weight >= 0.0 && weight <= heaviest_mixing) return weight;
    return 1.0;
}

void setMixingWeight (Clip& clip, int channel, double weight) { clip.notes.emplace_back (noteOf (channel), numberText (weight)); }

Clip weighted (Clip clip, Messages& losses)
{
    std::set<int> channels;
    for (const auto& t : clip.tracks)
        channels.insert (t.channel);
    bool is_limited = false, is_alone = false;
    for (auto& t : clip.tracks)
    {
        const double weight = mixingWeight (clip, t.channel);
        if (weight == 1.0) continue;
        if (channels.size() < 2)
        {
            is_alone = true;
            break;
        }
        const auto weigh = [&] (double& v) {
            const double wanted = weight * v;
            v = std::clamp (wanted, -1.0, 1.0);
            is_limited = is_limited || v != wanted;
        };
        for (auto& p : t.amplitude)
            weigh (p.value);
        for (auto& p : t.taps)
            weigh (p.amplitude);
    }
    std::erase_if (clip.notes, [] (const auto& note) { return isMixingNote (note.first); });
    if (is_alone) lose (losses, "channels", "the mixing weight is left out: there is no other channel to mix with", "no action is needed");
    if (is_limited) lose (losses, "channels", "the mixing weights raise amplitudes beyond 1; they are limited to it", "lower the weights");
    return clip;
}

}   // namespace tactus::readers
