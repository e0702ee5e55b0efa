// SPDX-License-Identifier: MIT
#include "clip_difference.hpp"
#include "clip_formats.hpp"

#include <tactus/kit/signal/clip_score.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace tactus::readers
{

namespace
{
constexpr double rate_hz = 2000.0, longest_s = 600.0;
constexpr double between = 0.4142;   // where in its interval a sample is taken: away from the round times at which drawn envelopes jump

ChannelDifference compare (const Clip& a, const Clip& b, int channel)
{
    const ClipScore first (a, channel), second (b, channel);
    std::vector<ClipScore::Cursor> at_first (first.size()), at_second (second.size());
    ChannelDifference made { .channel = channel, .duration = std::max (first.duration(), second.duration()) };
    const auto samples = static_cast<std::size_t> (std::ceil (std::min (made.duration, longest_s) * rate_hz));
    double squares = 0.0, differences = 0.0, hertz = 0.0;
    std::size_t together = 0;
    for (std::size_t k = 0; k < samples; ++k)
    {
        const double t = (static_cast<double> (k) + between) / rate_hz;
        const auto x = first (t, 0.0, at_first.data()), y = second (t, 0.0, at_second.data());
        squares += x.amplitude * x.amplitude;
        differences += (x.amplitude - y.amplitude) * (x.amplitude - y.amplitude);
        if (! (x.frequency > 0.0 && y.frequency > 0.0)) continue;
        hertz += (x.frequency - y.frequency) * (x.frequency - y.frequency);
        ++together;
    }
    if (samples == 0) return made;
    made.rms = std::sqrt (squares / static_cast<double> (samples));
    made.difference = std::sqrt (differences / static_cast<double> (samples));
    if (together > 0) made.frequency = std::sqrt (hertz / static_cast<double> (together));
    return made;
}
}   // namespace

std::vector<ChannelDifference> compareClips (const Clip& first, const Clip& second, bool mixed)
{
    // In a channel with envelopes in one clip and waves in the other, the envelopes of the waves are compared.
    const auto hasBoth = [&] (int channel) {
        bool kinds[2][2] {};
        for (const auto* clip : { &first, &second })
            for (const auto& t : clip->tracks)
                if (channel == 0 || t.channel == channel) kinds[clip == &first][t.is_wave] = kinds[clip == &first][t.is_wave] || ! t.amplitude.empty();
        return kinds[0][0] != kinds[1][0] || kinds[0][1] != kinds[1][1];
    };
    std::set<int> channels;
    if (mixed) channels.insert (0);
    for (const auto* clip : { &first, &second })
        for (const auto& t : clip->tracks)
            if (! mixed) channels.insert (t.channel);
    std::optional<std::pair<Clip, Clip>> envelopes;
    std::vector<ChannelDifference> all;
    for (const int channel : channels)
    {
        const bool as_envelopes = hasBoth (channel);
        if (as_envelopes && ! envelopes) envelopes.emplace (withoutWaves (first), withoutWaves (second));
        all.push_back (as_envelopes ? compare (envelopes->first, envelopes->second, channel) : compare (first, second, channel));
    }
    return all;
}

namespace
{
std::vector<double> sumOf (const ChannelSamples& all)
{
    std::vector<double> sum;
    for (const auto& [channel, samples] : all)
    {
        sum.resize (std::max (sum.size(), samples.size()));
        for (std::size_t k = 0; k < samples.size(); ++k)
            sum[k] += samples[k];
    }
    return sum;
}

SampleDifference compareTwo (const std::vector<double>& a, const std::vector<double>& b, int channel)
{
    const auto count = std::max (a.size(), b.size());
    double squares = 0.0, differences = 0.0;
    for (std::size_t k = 0; k < count; ++k)
    {
        const double x = k < a.size() ? a[k] : 0.0, y = k < b.size() ? b[k] : 0.0;
        squares += x * x;
        differences += (x - y) * (x - y);
    }
    const auto n = static_cast<double> (std::max<std::size_t> (count, 1));
    return { channel, std::sqrt (squares / n), std::sqrt (differences / n) };
}
}   // namespace

std::vector<SampleDifference> compareSamples (const ChannelSamples& first, const ChannelSamples& second, bool mixed)
{
    if (mixed) return { compareTwo (sumOf (first), sumOf (second), 0) };
    std::set<int> channels;
    for (const auto* all : { &first, &second })
        for (const auto& [channel, samples] : *all)
            channels.insert (channel);
    static const std::vector<double> silence {};
    const auto in = [] (const ChannelSamples& all, int channel) -> const std::vector<double>& {
        const auto found = all.find (channel);
        return found == all.end() ? silence : found->second;
    };
    std::vector<SampleDifference> made;
    for (const int channel : channels)
        made.push_back (compareTwo (in (first, channel), in (second, channel), channel));
    return made;
}

}   // namespace tactus::readers
