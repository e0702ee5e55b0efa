// SPDX-License-Identifier: GPL-3.0-or-later
#include "clip_io.hpp"
#include "clip_samples.hpp"
#include "wav.hpp"

#include <tactus/file/clips/clip_signal.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

constexpr double usual_rate_hz = 8000.0;

std::string threeDigits (double v)
{
    constexpr double rounding = 1e-9;
    char text[32];
    std::snprintf (text, sizeof text, "%.3g", v < rounding ? 0.0 : v);
    return text;
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

Result<SavedClip> saveWave (const Clip& clip, const fs::path& path, double wanted_hz)
{
    const double rate_hz = rateFor (clip, wanted_hz);
    if (auto fits = checkRendered (clip, rate_hz, "write fewer samples per second"); ! fits) return fits.error();
    const auto all = renderClip (clip, rate_hz);
    if (all.channels.empty()) return Message::error ("clip/too_few", path.string(), "the clip has no channel to render", "check that it is a clip");
    auto file = WavWriter::create (path, rate_hz, all.channels.size());
    if (! file) return file.error();
    std::vector<double> frame (all.channels.size());
    for (std::size_t k = 0; k < all.value.front().size(); ++k)
    {
        for (std::size_t c = 0; c < frame.size(); ++c)
            frame[c] = all.value[c][k];
        if (auto written = file->frame (frame); ! written) return written.error();
    }
    if (auto written = file->commit(); ! written) return written.error();
    Messages ignored;
    Clip back = readers::clipOfSignal ({ .rate_hz = rate_hz, .channels = all.value }, ignored);
    for (std::size_t c = 0; c < back.tracks.size(); ++c)
        back.tracks[c].channel = all.channels[c];
    return SavedClip { {}, readers::compareClips (clip, back, false), false };
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
    SavedClip saved { {}, readers::compareClips (clip, clipOf (grid).clip, false), false };
    for (const auto& [key, value] : clip.notes)
        saved.losses.push_back (
            Message::warning ("clip/not_carried", "notes/" + key, "the note is left out: a table holds only numbers", "keep the original file"));
    return saved;
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

Result<readers::ClipFile> loadClip (const fs::path& path)
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
    if (bytes) return readers::readClip (*bytes, name);
    const auto& why = bytes.error();
    return Message::error (why.id, name, why.text, why.remedy.empty() ? "check the path and its permissions" : why.remedy);
}

Result<> checkRendered (const Clip& clip, double rate_hz, const std::string& remedy)
{
    const double numbers = (clip.lastEvent() + 1.0) * rate_hz * static_cast<double> (std::max<std::size_t> (1, clip.tracks.size()));
    if (numbers > budgets().numbers) return overBudget ("clip/too_large", &Budgets::numbers, "the rendered clip", numbers, remedy);
    return {};
}

Result<SavedClip> saveClip (const Clip& clip, const fs::path& path, double rate_hz)
{
    const auto extension = extensionOf (path);
    if (extension == ".wav") return saveWave (clip, path, rate_hz);
    if (extension == ".csv") return saveRows (clip, path);
    auto made = readers::writeClip (clip, path.string());
    if (! made) return made.error();
    auto back = readers::readClip (made->text, path.string());
    if (! back) return back.error();
    if (auto written = writeTextFile (path, made->text); ! written) return written.error();
    const bool is_mixed = extension == ".haptic" || extension == ".ahap";
    return SavedClip { std::move (made->losses), readers::compareClips (clip, back->clip, is_mixed), is_mixed };
}

std::vector<std::string> differenceReport (const SavedClip& saved)
{
    constexpr double none = 1e-9, little_hertz = 0.05;
    std::vector<std::string> sentences;
    for (const auto& d : saved.differences)
    {
        if (d.difference <= none && d.frequency <= little_hertz) continue;
        sentences.push_back ((saved.is_mixed ? "all channels" : "channel " + std::to_string (d.channel)) + ": the envelope differs by "
                             + threeDigits (d.difference) + " rms, " + threeDigits (100.0 * d.part()) + " % of its " + threeDigits (d.rms)
                             + "; the frequency by " + threeDigits (d.frequency) + " Hz rms");
    }
    if (sentences.empty()) sentences.emplace_back ("none in the rendered envelope and frequency");
    return sentences;
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
