// SPDX-License-Identifier: GPL-3.0-or-later
#include "stem_clips.hpp"
#include "stems.hpp"

#include <host/devices/audio/high_pass.hpp>
#include <host/devices/audio/listening.hpp>
#include <tactus/file/clips/clip_file.hpp>
#include <tactus/file/clips/clip_signal.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

const std::vector<std::string>& stemClipFormats()
{
    static const std::vector<std::string> all { "haptic", "ahap", "hjif" };
    return all;
}

namespace
{
double rmsOf (const std::vector<float>& samples)
{
    double sum = 0.0;
    for (const float v : samples)
        sum += double { v } * double { v };
    return samples.empty() ? 0.0 : std::sqrt (sum / static_cast<double> (samples.size()));
}

/// Leaves out what an actuator that vibrates cannot play. The signal begins as if its first sample had been held before, a loop as if it had gone on. Samples
/// that are not finite become 0.
void removeHeld (OneSignal& signal, double rate_hz, bool loops)
{
    constexpr double noticed = 0.95;
    auto& samples = signal.samples;
    for (auto& v : samples)
        if (! std::isfinite (v)) v = 0.0f;
    if (samples.empty()) return;
    const double before = rmsOf (samples), first = double { samples.front() };
    audio::HighPass high_pass (OneSignal::cutoff_hz, rate_hz);
    for (std::size_t k = 0; loops && k < samples.size(); ++k)
        (void)high_pass (double { samples[k] } - first);
    for (auto& v : samples)
        v = static_cast<float> (high_pass (double { v } - first));
    signal.lacks_held = rmsOf (samples) < noticed * before;
}
}   // namespace

OneSignal oneSignalOf (const std::vector<std::vector<float>>& channels, const std::vector<std::string>& names, double rate_hz, bool loops)
{
    OneSignal one;
    if (channels.size() == 3)
    {
        const std::vector<const std::vector<float>*> parts { &channels[0], &channels[1], &channels[2] };
        auto along = mainDirection (parts);
        if (along.empty()) along = { 0.0, 0.0, 1.0 };   // what is not finite becomes 0 by removeHeld()
        for (std::size_t k = 0; k < channels[0].size(); ++k)
        {
            double sum = 0.0;
            for (std::size_t c = 0; c < 3; ++c)
                sum += along[c] * double { channels[c][k] };
            one.samples.push_back (static_cast<float> (sum));
        }
        one.channel = "along " + numberText (along[0]) + " " + numberText (along[1]) + " " + numberText (along[2]);
    }
    else
    {
        one.samples = channels.front();
        one.channel = names.front();
    }
    removeHeld (one, rate_hz, loops);
    for (const float v : one.samples)
        one.peak = std::max (one.peak, std::abs (double { v }));
    return one;
}

Result<std::string> clipTextOf (const OneSignal& signal, double rate_hz, double full_scale, const std::string& description, const std::string& format,
                                Messages& losses)
{
    std::vector<double> samples;
    samples.reserve (signal.samples.size());
    for (const float v : signal.samples)
        samples.push_back (std::clamp (double { v } / full_scale, -1.0, 1.0));
    if (signal.lacks_held)
        losses.push_back (Message::warning ("clip/held", {},
                                            "a force that is held is left out, and what changes more slowly than 8 times a second is weaker: a clip vibrates"));
    auto clip = readers::clipOfSignal ({ .rate_hz = rate_hz, .channels = { std::move (samples) } }, losses);
    clip.notes = { { "description", description } };
    auto made = readers::writeClip (clip, "stem." + format);
    if (! made) return std::move (made).error();
    losses.insert (losses.end(), made->losses.begin(), made->losses.end());
    return std::move (made->text);
}

}   // namespace tactus::host
