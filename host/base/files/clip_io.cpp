// SPDX-License-Identifier: MIT
#include "clip_io.hpp"
#include "clip_samples.hpp"
#include "clip_sounds.hpp"
#include "wav.hpp"

#include <tactus/file/clips/clip_mixing.hpp>
#include <tactus/file/clips/clip_signal.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

constexpr double usual_rate_hz = 8000.0;

std::string threeDigits (double v)
{
    constexpr double rounding = 1e-9;
    return roundedText (v < rounding ? 0.0 : v, 3);
}

/// The rate of the recording that a clip came from, or the usual one.
double rateFor (const Clip& clip, double wanted_hz)
{
    if (wanted_hz > 0.0) return wanted_hz;
    for (const auto& [key, value] : clip.notes)
        if (key == "rate")
            if (const double rate = readNumber (value).value; rate >= 1.0 && rate <= 1e6) return rate;
    return usual_rate_hz;
}

/// The clip as its channels are added up, if they are.
Clip asMixed (const Clip& clip, bool is_mixed)
{
    Messages told_by_the_writer;
    return is_mixed ? readers::weighted (clip, told_by_the_writer) : clip;
}

std::vector<ClipLoss> lossesOf (const Clip& clip, const Clip& back, bool is_mixed, const std::string& why = {})
{
    std::vector<ClipLoss> losses;
    for (const auto& d : readers::compareClips (asMixed (clip, is_mixed), back, is_mixed))
        losses.push_back ({ is_mixed ? "all channels" : "channel " + std::to_string (d.channel), d, why });
    return losses;
}

/// The largest value of a signal, at least 1.
double peakOf (const RenderedClip& rendered)
{
    double peak = 1.0;
    for (const auto& channel : rendered.value)
        for (const double v : channel)
            peak = std::max (peak, std::abs (v));
    return peak;
}

/// The recording as a clip that compares with the one it was rendered from: as loud, on the same channels.
Clip clipOfRendered (const RenderedClip& rendered, double rate_hz)
{
    Messages ignored;
    Clip clip = readers::clipOfSignal ({ .rate_hz = rate_hz, .channels = rendered.value }, ignored);
    const double peak = peakOf (rendered);   // clipOfSignal divides by it
    for (std::size_t c = 0; c < clip.tracks.size(); ++c)
    {
        clip.tracks[c].channel = rendered.channels[c];
        for (auto& p : clip.tracks[c].amplitude)
            p.value *= peak;
    }
    return clip;
}

/// Other programs clip samples beyond 1, and signal.clip refuses them.
Result<SavedClip> saveWave (const Clip& clip, const fs::path& path, double wanted_hz, readers::SampleTimes& times, readers::ChannelSamples& samples)
{
    const double rate_hz = rateFor (clip, wanted_hz);
    if (auto fits = checkRendered (clip, rate_hz, "write fewer samples per second"); ! fits) return fits.error();
    const auto all = renderClip (clip, rate_hz);
    if (all.channels.empty()) return Message::error ("clip/too_few", path.string(), "the clip has no channel to render", "check that it is a clip");
    auto file = WavWriter::create (path, rate_hz, all.channels.size());
    if (! file) return file.error();
    const double peak = peakOf (all);
    std::vector<double> frame (all.channels.size());
    for (std::size_t k = 0; k < all.value.front().size(); ++k)
    {
        for (std::size_t c = 0; c < frame.size(); ++c)
            frame[c] = all.value[c][k] / peak;
        if (auto written = file->frame (frame); ! written) return written.error();
    }
    if (auto written = file->commit(); ! written) return written.error();
    times = { rate_hz, 0.0, std::min (times.count, all.value.front().size()) };
    for (std::size_t c = 0; c < all.channels.size(); ++c)
        samples[all.channels[c]].assign (all.value[c].begin(), all.value[c].begin() + static_cast<std::ptrdiff_t> (times.count));
    const bool is_wave = std::ranges::all_of (clip.tracks, &ClipTrack::is_wave);
    SavedClip saved { {},
                      lossesOf (clip, clipOfRendered (all, rate_hz), false,
                                is_wave ? "" : "read back from the samples in steps of 10 ms; the samples are the signal that the clip plays"),
                      false };
    for (const auto& [key, value] : clip.notes)
        if (key != "rate")
            saved.losses.push_back (Message::warning ("clip/not_carried", "notes/" + key,
                                                      "the " + key + " of the clip is left out: a WAV of Tactus holds only samples", "keep the original file"));
    if (peak > 1.0)
        saved.losses.push_back (Message::warning (
            "clip/changed", path.string(), "the signal reaches " + roundedText (peak) + ", so all samples are divided by this number: beyond 1, programs clip",
            "multiply the gain of the signal.clip that plays it by " + roundedText (peak)));
    return saved;
}

Result<SavedClip> saveRows (const Clip& clip, const fs::path& path)
{
    static const std::vector<std::string> columns { "kind", "track", "a", "b", "c" };
    const auto grid = gridOf (clip);
    auto file = TableWriter::create (path, columns);
    if (! file) return file.error();
    for (int r = 0; r < grid.rows; ++r)
        if (auto written = file->row (std::span (grid.values).subspan (at (r) * columns.size(), columns.size())); ! written) return written.error();
    if (auto written = file->commit(); ! written) return written.error();
    SavedClip saved { {}, lossesOf (clip, clipOf (grid).clip, false), false };
    for (const auto& [key, value] : clip.notes)
        saved.losses.push_back (Message::warning ("clip/not_carried", "notes/" + key,
                                                  "the " + key + " of the clip is left out: a table holds only numbers", "keep the original file"));
    return saved;
}

/// Only the envelopes of a clip, or only its transients.
Clip partOf (Clip clip, bool taps)
{
    for (auto& t : clip.tracks)
        taps ? t.amplitude.clear() : t.taps.clear();
    return clip;
}

/// A phone applies the curves of an .ahap to its transients too. So this compares what the file holds, envelope and transients apart, and then how a
/// phone plays it.
std::vector<ClipLoss> lossesOfAhap (const Clip& clip, const Clip& back, const std::string& name)
{
    auto played = lossesOf (clip, back, true);
    const auto has = [&] (auto part) { return std::ranges::any_of (clip.tracks, [&] (const ClipTrack& t) { return ! (t.*part).empty(); }); };
    if (! has (&ClipTrack::amplitude) || ! has (&ClipTrack::taps)) return played;
    std::vector<ClipLoss> losses;
    for (const bool taps : { false, true })
    {
        const auto part = partOf (clip, taps);
        const auto made = readers::writeClip (part, name);
        const auto read = made ? readers::readClip (made->text, name) : made.error();
        if (! read) return played;
        for (auto& loss : lossesOf (part, read->clip, true))
            losses.push_back ({ loss.part + (taps ? ", the transients alone" : ", the envelope alone"), loss.difference, {} });
    }
    for (auto& loss : played)
        losses.push_back ({ loss.part + ", as a phone plays the file", loss.difference,
                            "the curves act on the transients too, and dip at each, as in files of Meta's converter; two files by --split do not" });
    return losses;
}
}   // namespace

std::string extensionOf (const fs::path& file)
{
    auto extension = file.extension().string();
    std::ranges::transform (extension, extension.begin(), [] (char c) { return c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c; });
    return extension;
}

bool isClipExtension (const fs::path& file)
{
    static const std::array<std::string, 4> known { ".haptic", ".ahap", ".hjif", ".wav" };
    return std::ranges::count (known, extensionOf (file)) > 0;
}

bool isClipFile (const fs::path& file)
{
    if (extensionOf (file) != ".json") return isClipExtension (file);
    const auto bytes = readFile (file.string());
    return bytes && readers::readClip (*bytes, file.string()).has_value();
}

Result<readers::ClipFile> loadClip (const fs::path& path, bool as_node)
{
    const auto name = path.string(), extension = extensionOf (path);
    readers::ClipFile made;
    if (extension == ".wav")
    {
        auto signal = readWav (path);
        if (! signal) return signal.error();
        made.clip = readers::clipOfSignal (*signal, made.notes);
        return made;
    }
    if (extension == ".csv")
    {
        auto table = readTable (path);
        if (! table) return table.error();
        auto clip = clipOfTable (*table, name, made.notes);
        if (! clip) return clip.error();
        made.clip = std::move (*clip);
        return made;
    }
    if (extension == ".hmpg")
        return Message::error ("clip/unknown_kind", name, "the binary form of MPEG haptics is not decoded", "save the effect as .hjif");
    if (! readers::isClipName (name))
        return Message::error ("clip/unknown_kind", name, "there is no clip format with the extension " + quote (extension),
                               "clips are .haptic, .ahap, .hjif, .json, .wav and .csv");
    auto bytes = readFile (name);
    if (bytes)
    {
        auto read = readers::readClip (*bytes, name, as_node ? readers::ReadSound {} : soundsBeside (path));
        if (! read) return read.error();
        read->name = name;
        read->text = std::move (*bytes);
        return read;
    }
    const auto& why = bytes.error();
    return Message::error (why.id, name, why.text, why.remedy.empty() ? "check the path and its permissions" : why.remedy);
}

Result<> checkRendered (const Clip& clip, double rate_hz, const std::string& remedy)
{
    const double numbers = (clip.lastEvent() + 1.0) * rate_hz * static_cast<double> (std::max<std::size_t> (1, clip.tracks.size()));
    if (numbers > budgets().numbers) return overBudget ("clip/too_large", &Budgets::numbers, "the rendered clip", numbers, remedy);
    return {};
}

namespace
{
Result<SavedClip> saveText (const Clip& clip, const fs::path& path, readers::SampleTimes& times, readers::ChannelSamples& samples)
{
    const auto extension = extensionOf (path), name = path.string();
    auto made = readers::writeClip (clip, name);
    if (! made) return made.error();
    auto back = readers::readClip (made->text, name);
    if (! back) return back.error();
    if (auto written = writeTextFile (path, made->text); ! written) return written.error();
    const bool is_mixed = extension == ".haptic" || extension == ".ahap";
    auto rendered = readers::renderFile (made->text, name, ClipVoice {}, times);
    samples = rendered ? std::move (*rendered) : readers::renderSamples (back->clip, times);
    return SavedClip { std::move (made->losses), extension == ".ahap" ? lossesOfAhap (clip, back->clip, name) : lossesOf (clip, back->clip, is_mixed),
                       is_mixed };
}

/// The times of a comparison: between the round times at which drawn envelopes step, at a rate that is prime, so that they are not at one place between the
/// ticks of a format either, and few enough to take only a moment.
readers::SampleTimes comparisonOf (const Clip& clip, double& seconds)
{
    constexpr double rate_hz = 7993.0, offset = 0.4142, longest_s = 600.0, most = 1e7;
    constexpr double tail_s = 0.05;   // the longest transient
    const double all = clip.lastEvent() + tail_s;
    seconds = std::min ({ all, longest_s, most / rate_hz / static_cast<double> (std::max<std::size_t> (1, clip.tracks.size())) });
    const auto count = static_cast<std::size_t> (seconds * rate_hz);
    if (seconds >= all) seconds = 0.0;   // nothing was left out
    return { rate_hz, offset, count };
}
}   // namespace

Result<SavedClip> saveClip (const Clip& clip, const fs::path& path, double rate_hz, const readers::ClipFile* source)
{
    double seconds = 0.0;
    auto times = comparisonOf (clip, seconds);
    readers::ChannelSamples written;
    const auto extension = extensionOf (path);
    auto saved = extension == ".wav" ? saveWave (clip, path, rate_hz, times, written) : extension == ".csv" ? saveRows (clip, path)
                                                                                                            : saveText (clip, path, times, written);
    if (! saved) return saved;
    if (extension == ".csv") written = readers::renderSamples (clip, times);   // the rows are the clip, number by number
    // The comparison is with the file that the clip was read from, unless the clip has been edited since.
    const bool is_same = source != nullptr && source->clip == clip;
    const auto original = is_same ? readers::renderFile (source->text, source->name, ClipVoice {}, times, { source->sounds, saved->is_mixed }) : std::nullopt;
    saved->samples =
        readers::compareSamples (original ? *original : readers::renderSamples (asMixed (clip, saved->is_mixed), times), written, saved->is_mixed);
    saved->compared = original ? "an independent rendering of " + printableName (fs::path (source->name).filename().string()) : "the clip";
    if (source != nullptr && ! is_same) saved->compared = "the clip after it was changed, and not with its file";
    if (seconds > 0.0) saved->compared += ", in its first " + threeDigits (seconds) + " s";
    if (source != nullptr)
    {
        auto notes = source->leftOut();
        saved->losses.insert (saved->losses.begin(), std::make_move_iterator (notes.begin()), std::make_move_iterator (notes.end()));
    }
    return saved;
}

std::vector<std::string> differenceReport (const SavedClip& saved)
{
    constexpr double none = 1e-9, little_hertz = 0.05, little_part = 1e-3;
    std::vector<std::string> sentences;
    for (const auto& [part, d, why] : saved.differences)
    {
        if (d.difference <= none && d.frequency <= little_hertz) continue;
        sentences.push_back (part + ": the envelope differs by " + threeDigits (d.difference) + " rms, " + threeDigits (100.0 * d.part()) + " % of its "
                             + threeDigits (d.rms) + "; the frequency by " + threeDigits (d.frequency) + " Hz rms" + (why.empty() ? "" : " (" + why + ")"));
    }
    for (const auto& d : saved.samples)
    {
        if (d.part() <= little_part) continue;
        const auto part = d.channel == 0 ? std::string ("all channels") : "channel " + std::to_string (d.channel);
        sentences.push_back (part + ": the samples differ by " + threeDigits (d.difference) + " rms, " + threeDigits (100.0 * d.part()) + " % of their "
                             + threeDigits (d.rms) + ", from " + saved.compared);
    }
    if (! sentences.empty()) return sentences;
    // "None" is a claim about all that was lost, so it is made only if nothing else was.
    const auto where = "in the rendered envelope and frequency; the samples differ by less than 0.1 % from " + saved.compared;
    return { (saved.losses.empty() ? "none " : "nothing else ") + where };
}

std::vector<std::string> lossReport (const SavedClip& saved)
{
    std::vector<std::string> sentences;
    for (const auto& m : saved.losses)
        sentences.push_back (m.where + ": " + m.text);
    std::ranges::copy (differenceReport (saved), std::back_inserter (sentences));
    return sentences;
}

}   // namespace tactus::host
