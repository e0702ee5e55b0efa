// SPDX-License-Identifier: GPL-3.0-or-later
#include "stem_clips.hpp"
#include "stems.hpp"

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
/// The mean over 0.1 s around each sample.
std::vector<double> meansOf (const std::vector<double>& samples, double rate_hz)
{
    constexpr double window_s = 0.1;
    std::vector<double> sums { 0.0 }, means;   // sums of the samples before each
    for (const double v : samples)
        sums.push_back (sums.back() + v);
    const auto half = static_cast<std::size_t> (std::max (1.0, std::round (0.5 * window_s * rate_hz)));
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
        const auto first = k - std::min (k, half), last = std::min (samples.size(), k + half + 1);
        means.push_back ((sums[last] - sums[first]) / static_cast<double> (last - first));
    }
    return means;
}

/// Subtracts the mean of the means, which leaves 96 % or more of what is faster than 15 Hz. Samples that are not finite become 0.
void removeHeld (OneSignal& signal, double rate_hz)
{
    std::vector<double> samples;
    for (const float v : signal.samples)
        samples.push_back (std::isfinite (v) ? double { v } : 0.0);
    const auto slow = meansOf (meansOf (samples, rate_hz), rate_hz);
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
        signal.held = std::max (signal.held, std::abs (slow[k]));
        signal.samples[k] = static_cast<float> (samples[k] - slow[k]);
    }
}
}   // namespace

OneSignal oneSignalOf (const std::vector<std::vector<float>>& channels, const std::vector<std::string>& names, double rate_hz)
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
    removeHeld (one, rate_hz);
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
    constexpr double noticed = 0.01;   // of amplitude 1
    if (signal.held > noticed * full_scale)
        losses.push_back (Message::warning ("clip/held", {},
                                            "forces that are held, and all that changes more slowly than 10 times a second, are left out: a clip vibrates"));
    auto clip = readers::clipOfSignal ({ .rate_hz = rate_hz, .channels = { std::move (samples) } }, losses);
    clip.notes = { { "description", description } };
    auto made = readers::writeClip (clip, "stem." + format);
    if (! made) return std::move (made).error();
    losses.insert (losses.end(), made->losses.begin(), made->losses.end());
    return std::move (made->text);
}

}   // namespace tactus::host
