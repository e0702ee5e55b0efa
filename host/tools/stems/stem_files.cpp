// SPDX-License-Identifier: GPL-3.0-or-later
#include "stem_files.hpp"
#include "stem_clips.hpp"

#include <host/base/platform/atomic_folder.hpp>
#include <host/devices/audio/listening.hpp>
#include <host/devices/audio/resample_file.hpp>
#include <tactus/kit/random.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

constexpr double loudest = 0.8912509381337456;   // -1 dBFS

/// The entry of a file in stems.json.
Json describe (const WrittenStem& s)
{
    const auto listOf = [] (const std::vector<std::string>& texts) {
        auto list = Json::array();
        for (const auto& t : texts)
            list.push_back (t);
        return list;
    };
    Json file { { "file", s.file }, { "kind", s.kind }, { "label", s.label }, { "from", s.from } };
    file["channels"] = listOf (s.channels);
    if (! s.not_applied.empty()) file["not_applied"] = listOf (s.not_applied);
    file["unit"] = s.unit;
    file["full_scale"] = s.full_scale;
    file["peak"] = s.peak;
    file["clipped"] = s.clipped;
    return file;
}

/// The steps from recorded stems to files.
class Writer
{
public:
    Writer (RecordedStems r, const StemOptions& o) : recorded (r), options (o) {}

    Result<WrittenStems> write (const fs::path& folder, const std::string& name)
    {
        if (recorded.stems.empty() || recorded.frames == 0)
            return Message::error ("stems/nothing", {}, "nothing is wired into a motor, so there are no stems", "wire a force or a vibration to a device node");
        const double rate_hz = options.rate_hz > 0.0 ? options.rate_hz : recorded.rate_hz;
        if (! (rate_hz >= 1.0 && rate_hz <= 768e3) || std::floor (rate_hz) != rate_hz)
            return Message::error ("wav/sample_rate", {}, "a WAV file cannot have a sample rate of " + roundedText (rate_hz, 12) + " Hz",
                                   "choose a rate in whole Hz, up to 768 kHz");
        if (options.is_mono) fold();
        if (options.loop_s > 0.0)
            if (auto looped = loop (rate_hz); ! looped) return looped.error();
        Messages losses;
        const auto clips = clipsOf (losses);
        if (! clips) return clips.error();
        resample (rate_hz);
        findScale();

        auto made = AtomicFolder::create (folder, list_of_stems);
        if (! made) return std::move (made).error();
        WrittenStems written { .rate_hz = rate_hz, .frames = recorded.frames };
        written.losses = std::move (losses);
        std::string list;
        auto files = Json::array(), sums = Json::array();
        const auto note = [&] (const WrittenStem& to) {
            list += to.file + '\n';
            files.push_back (describe (to));
            written.files.push_back (to);
        };
        for (auto& stem : recorded.stems)
        {
            if (auto done = made->write (stem.to.file, bytesOf (stem, rate_hz)); ! done) return done.error();
            note (stem.to);
        }
        for (const auto& [to, text] : *clips)
        {
            if (auto done = made->write (to.file, text); ! done) return done.error();
            note (to);
        }
        for (const auto& m : recorded.mixers)
        {
            written.sums.push_back ({ m.path, m.unit(), m.difference, m.peak });
            sums.push_back (Json { { "mixer", m.path }, { "unit", m.unit() }, { "largest_difference", m.difference }, { "peak", m.peak } });
        }
        Json said { { "format", "tactus-stems" }, { "version", 1 }, { "name", name }, { "rate_hz", rate_hz }, { "frames", recorded.frames } };
        said["loop_blend_s"] = options.loop_s;
        said["files"] = files;
        said["sums"] = sums;
        if (auto done = made->write ("stems.json", said.dump (2) + "\n"); ! done) return done.error();
        if (auto done = made->write (list_of_stems, list + "stems.json\n"); ! done) return done.error();
        if (auto kept = made->keepOthers(); ! kept) return kept.error();
        if (auto done = made->commit(); ! done) return done.error();
        return written;
    }

private:
    /// Turns each vector into its component in the main direction of the mix of its role, if this mix is a vector. All else stays as it is.
    void fold()
    {
        std::map<std::string, std::vector<double>> directions;
        for (const auto& s : recorded.stems)
        {
            if (s.to.kind != "mix" || s.channels.size() != 3) continue;
            const std::vector<const std::vector<float>*> force { &s.channels[0], &s.channels[1], &s.channels[2] };
            directions[s.role] = mainDirection (force);
        }
        for (auto& s : recorded.stems)
        {
            const auto direction = directions.find (s.role);
            if (s.channels.size() != 3 || direction == directions.end() || direction->second.empty()) continue;
            for (std::size_t k = 0; k < recorded.frames; ++k)
            {
                double sum = 0.0;
                for (std::size_t c = 0; c < 3; ++c)
                    sum += direction->second[c] * double { s.channels[c][k] };
                s.channels[0][k] = static_cast<float> (sum);
            }
            s.channels.resize (1);
            const auto& along = direction->second;
            s.to.channels = { "along " + numberText (along[0]) + " " + numberText (along[1]) + " " + numberText (along[2]) };
        }
    }

    /// Blends the samples after the end of the loop into its start, so that the end continues at the start. The weights add up to 1, so a constant force
    /// stays constant.
    Result<> loop (double to_hz)
    {
        const auto blend = static_cast<std::size_t> (std::lround (options.loop_s * recorded.rate_hz));
        auto length = recorded.frames - std::min (blend, recorded.frames);
        // A whole number of samples at the new rate, too.
        const auto from = static_cast<std::uint64_t> (std::lround (recorded.rate_hz)), to = static_cast<std::uint64_t> (std::lround (to_hz));
        length -= length % static_cast<std::size_t> (from / std::gcd (from, to));
        if (blend == 0 || length <= blend)
            return Message::error ("stems/loop", {}, "the run is too short for a loop with a blend of " + numberText (options.loop_s) + " s",
                                   "run for more than twice this time, or blend over a shorter one");
        for (auto& s : recorded.stems)
            for (auto& c : s.channels)
            {
                for (std::size_t k = 0; k < blend; ++k)
                {
                    const double w = 0.5 - 0.5 * std::cos (std::numbers::pi * (static_cast<double> (k) + 0.5) / static_cast<double> (blend));
                    c[k] = static_cast<float> (w * double { c[k] } + (1.0 - w) * double { c[length + k] });
                }
                c.resize (length);
            }
        recorded.frames = length;
        return {};
    }

    void resample (double to_hz)
    {
        if (to_hz == recorded.rate_hz) return;
        const auto wanted = static_cast<std::size_t> (std::llround (static_cast<double> (recorded.frames) * to_hz / recorded.rate_hz));
        for (auto& s : recorded.stems)
            for (auto& c : s.channels)
            {
                // A loop is extended by itself, a run by its first and its last value.
                const bool is_loop = options.loop_s > 0.0;
                const std::size_t around = is_loop ? recorded.frames : static_cast<std::size_t> (std::lround (0.05 * recorded.rate_hz)) + 1;
                std::vector<float> longer;
                longer.reserve (recorded.frames + 2 * around);
                is_loop ? longer.insert (longer.end(), c.begin(), c.end()) : longer.insert (longer.end(), around, c.front());
                longer.insert (longer.end(), c.begin(), c.end());
                is_loop ? longer.insert (longer.end(), c.begin(), c.end()) : longer.insert (longer.end(), around, c.back());
                auto made = audio::resampled (std::move (longer), recorded.rate_hz, to_hz);
                const auto first = static_cast<std::size_t> (std::llround (static_cast<double> (around) * to_hz / recorded.rate_hz));
                made.resize (std::max (made.size(), first + wanted), made.empty() ? 0.0f : made.back());
                c.assign (made.begin() + static_cast<std::ptrdiff_t> (first), made.begin() + static_cast<std::ptrdiff_t> (first + wanted));
            }
        recorded.frames = wanted;
    }

    void findScale()
    {
        double most = 0.0;
        for (auto& s : recorded.stems)
        {
            for (const auto& c : s.channels)
                for (const float v : c)
                    if (std::isfinite (v)) s.to.peak = std::max (s.to.peak, std::abs (double { v }));
            most = std::max (most, s.to.peak);
        }
        for (auto& s : recorded.stems)
        {
            const double peak = options.scale == StemOptions::Scale::each ? s.to.peak : most;
            s.to.full_scale = options.scale == StemOptions::Scale::physical ? options.full_scale : peak > 0.0 ? peak / loudest
                                                                                                              : 1.0;
        }
    }

    /// The clips of the layers and of what is not mixed, with their texts.
    Result<std::vector<std::pair<WrittenStem, std::string>>> clipsOf (Messages& losses) const
    {
        std::vector<std::pair<const Stem*, OneSignal>> parts;
        double most = 0.0;
        for (const auto& s : recorded.stems)
            if (! options.clips.empty() && (s.to.kind == "layer" || s.to.kind == "not_mixed"))
                most = std::max (most, parts.emplace_back (&s, oneSignalOf (s.channels, s.to.channels, recorded.rate_hz, options.loop_s > 0.0)).second.peak);
        std::vector<std::pair<WrittenStem, std::string>> made;
        for (const auto& [s, signal] : parts)
            for (const auto& format : options.clips)
            {
                WrittenStem to { .file = fs::path (s->to.file).replace_extension (format).string(), .kind = "clip", .label = s->to.label, .from = s->to.from };
                to.channels = { signal.channel };
                to.not_applied = s->to.not_applied;
                to.unit = s->to.unit;
                const double peak = options.scale == StemOptions::Scale::each ? signal.peak : most;
                to.full_scale = peak > 0.0 ? peak : 1.0;
                to.peak = signal.peak;
                Messages lost;
                const auto label = s->to.label.empty() ? s->to.from : s->to.label;
                auto text = clipTextOf (signal, recorded.rate_hz, to.full_scale, label, format, lost);
                if (! text) return std::move (text).error();
                for (auto& m : lost)
                {
                    m.where = '.' + format;
                    const auto isSame = [&] (const Message& known) { return known.where == m.where && known.text == m.text; };
                    if (std::ranges::none_of (losses, isSame)) losses.push_back (std::move (m));
                }
                made.emplace_back (std::move (to), std::move (*text));
            }
        return made;
    }

    std::string bytesOf (Stem& s, double to_hz) const
    {
        const auto format = options.format;
        auto out = wavHeader (to_hz, s.channels.size(), recorded.frames, format);
        const int bytes = static_cast<int> (host::bytesOf (format));
        const double top = format == SampleFormat::pcm16 ? 32767.0 : 8388607.0;
        Random random { 1 };
        for (std::size_t k = 0; k < recorded.frames; ++k)
            for (const auto& c : s.channels)
            {
                const double v = std::isfinite (c[k]) ? double { c[k] } / s.to.full_scale : 0.0;
                if (std::abs (v) > 1.0 + 1e-9) ++s.to.clipped;
                if (format == SampleFormat::float32)
                {
                    appendInteger (out, std::bit_cast<std::uint32_t> (static_cast<float> (v)), bytes);
                    continue;
                }
                const double noise = options.has_dither && s.to.peak > 0.0 ? random.uniform() + random.uniform() - 1.0 : 0.0;
                appendInteger (out, static_cast<std::uint32_t> (std::lround (std::clamp (v * top + noise, -top - 1.0, top))), bytes);
            }
        if (out.size() % 2 == 1) out += '\0';
        return out;
    }

    RecordedStems recorded;
    const StemOptions& options;
};
}   // namespace

Result<WrittenStems> writeStems (RecordedStems recorded, const StemOptions& options, const fs::path& folder, const std::string& name)
{
    return Writer (recorded, options).write (folder, name);
}

}   // namespace tactus::host
