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
#include <utility>

namespace tactus::host
{

const std::vector<std::string>& stemClipFormats()
{
    static const std::vector<std::string> all { "haptic", "ahap", "hjif" };
    return all;
}

namespace
{
double squaresOf (const std::vector<std::vector<float>>& channels)
{
    double sum = 0.0;
    for (const auto& c : channels)
        for (const float v : c)
            sum += double { v } * double { v };
    return sum;
}

/// Leaves out what an actuator that vibrates cannot play. The signal begins as if its first sample had been held before, a loop as if it had gone on.
void removeHeld (std::vector<float>& samples, double rate_hz, bool loops)
{
    if (samples.empty()) return;
    const double first = double { samples.front() };
    audio::HighPass high_pass (OneSignal::cutoff_hz, rate_hz);
    for (std::size_t k = 0; loops && k < samples.size(); ++k)
        (void)high_pass (double { samples[k] } - first);
    for (auto& v : samples)
        v = static_cast<float> (high_pass (double { v } - first));
}

/// The largest magnitude of a vector.
double peakOf (const std::vector<std::vector<float>>& channels)
{
    double most = 0.0;
    for (std::size_t k = 0; k < channels.front().size(); ++k)
    {
        double squares = 0.0;
        for (const auto& c : channels)
            squares += double { c[k] } * double { c[k] };
        most = std::max (most, squares);
    }
    return std::sqrt (most);
}

void tellHeld (const OneSignal& signal, Messages& losses)
{
    constexpr double noticed = 1.05;
    if (! signal.lacks_held) return;
    std::string text = "a force that is held is left out, and what changes more slowly than 8 times a second is weaker: a clip vibrates";
    if (signal.overshoot > noticed)
        text += ". Where such a force changes at once, the clip peaks at " + numberText (0.01 * std::round (100.0 * signal.overshoot)) + " times its peak";
    losses.push_back (Message::warning ("clip/held", {}, std::move (text)));
}
}   // namespace

OneSignal oneSignalOf (std::vector<std::vector<float>> channels, const std::vector<std::string>& names, double rate_hz, bool loops)
{
    constexpr double noticed = 0.95;
    if (channels.size() != 3) channels.resize (1);
    for (auto& c : channels)
        for (auto& v : c)
            if (! std::isfinite (v)) v = 0.0f;
    const double before = squaresOf (channels), peak_before = peakOf (channels);
    for (auto& c : channels)
        removeHeld (c, rate_hz, loops);
    OneSignal one;
    one.lacks_held = squaresOf (channels) < noticed * noticed * before;
    if (channels.size() == 3)
    {
        const std::vector<const std::vector<float>*> parts { &channels[0], &channels[1], &channels[2] };
        auto along = mainDirection (parts);
        if (along.empty()) along = { 0.0, 0.0, 1.0 };   // samples too large to square
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
        one.samples = std::move (channels.front());
        one.channel = names.front();
    }
    for (const float v : one.samples)
        one.peak = std::max (one.peak, std::abs (double { v }));
    if (peak_before > 0.0) one.overshoot = one.peak / peak_before;
    return one;
}

Stretch playableStretch (Stretch stretch, Messages& losses)
{
    const auto width = stretch.names.size();
    if (stretch.unit != "N" || (width != 1 && width != 3)) return stretch;
    std::vector<std::vector<float>> channels (width);
    for (std::size_t c = 0; c < width; ++c)
        for (std::size_t k = 0; k < stretch.ticks(); ++k)
            channels[c].push_back (static_cast<float> (stretch.value (k, c)));
    const auto one = oneSignalOf (std::move (channels), stretch.names, stretch.rate_hz, false);
    tellHeld (one, losses);
    const auto& first = stretch.names.front();
    stretch.names = { width == 1 ? first : first.substr (0, first.rfind ('.')) + ' ' + one.channel };   // "motor.force along 0 0 1"
    stretch.values.assign (one.samples.begin(), one.samples.end());
    return stretch;
}

Result<std::string> clipTextOf (const OneSignal& signal, double rate_hz, double full_scale, const std::string& description, const std::string& format,
                                Messages& losses)
{
    std::vector<double> samples;
    samples.reserve (signal.samples.size());
    for (const float v : signal.samples)
        samples.push_back (std::clamp (double { v } / full_scale, -1.0, 1.0));
    tellHeld (signal, losses);
    auto clip = readers::clipOfSignal ({ .rate_hz = rate_hz, .channels = { std::move (samples) } }, losses);
    clip.notes = { { "description", description } };
    auto made = readers::writeClip (clip, "stem." + format);
    if (! made) return std::move (made).error();
    losses.insert (losses.end(), made->losses.begin(), made->losses.end());
    return std::move (made->text);
}

}   // namespace tactus::host
