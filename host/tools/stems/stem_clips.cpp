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

OneSignal oneSignalOf (const std::vector<std::vector<float>>& channels, const std::vector<std::string>& names)
{
    OneSignal one;
    if (channels.size() == 3)
    {
        const std::vector<const std::vector<float>*> parts { &channels[0], &channels[1], &channels[2] };
        auto along = mainDirection (parts);
        if (along.empty()) along = { 0.0, 0.0, 1.0 };   // what is not finite becomes 0 below
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
    for (const float v : one.samples)
        if (std::isfinite (v)) one.peak = std::max (one.peak, std::abs (double { v }));
    return one;
}

Result<std::string> clipTextOf (const OneSignal& signal, double rate_hz, double full_scale, const std::string& description, const std::string& format,
                                Messages& losses)
{
    std::vector<double> samples;
    samples.reserve (signal.samples.size());
    for (const float v : signal.samples)
        samples.push_back (std::isfinite (v) ? std::clamp (double { v } / full_scale, -1.0, 1.0) : 0.0);
    auto clip = readers::clipOfSignal ({ .rate_hz = rate_hz, .channels = { std::move (samples) } }, losses);
    clip.notes = { { "description", description } };
    auto made = readers::writeClip (clip, "stem." + format);
    if (! made) return std::move (made).error();
    losses.insert (losses.end(), made->losses.begin(), made->losses.end());
    return std::move (made->text);
}

}   // namespace tactus::host
