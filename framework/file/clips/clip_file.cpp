// SPDX-License-Identifier: MIT
#include "clip_file.hpp"
#include "clip_formats.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace tactus::readers
{

namespace
{
enum class Format
{
    none,
    haptic,
    ahap,
    hjif,
    json
};

std::string extensionOf (std::string_view name)
{
    const auto dot = name.rfind ('.');
    std::string extension { dot == std::string_view::npos ? std::string_view {} : name.substr (dot + 1) };
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char> (c - 'A' + 'a');
    return extension;
}

Format formatOf (std::string_view name)
{
    const auto extension = extensionOf (name);
    if (extension == "haptic") return Format::haptic;
    if (extension == "ahap") return Format::ahap;
    if (extension == "hjif") return Format::hjif;
    return extension == "json" ? Format::json : Format::none;
}

/// The format of a .json, by the keys that the formats require.
Format inside (const ClipJson& file)
{
    const auto& root = file.root();
    if (file.isText (root, "format", "tactus-clip")) return Format::json;
    if (file.find (root, "Pattern")) return Format::ahap;
    if (file.find (root, "perceptions")) return Format::hjif;
    if (file.find (root, "signals")) return Format::haptic;
    file.refuse (root, "clip/unknown_kind", "it is JSON, but not a clip", R"(a clip of Tactus has "format": "tactus-clip")");
}

Message unknownKind (std::string_view name)
{
    return Message::error ("clip/unknown_kind", std::string (name), "there is no clip format with the extension " + quote (extensionOf (name)),
                           "clips are .haptic, .ahap, .hjif and .json");
}

Clip readAs (Format format, ClipJson& file, const ReadSound& read_sound, ClipSounds& sounds)
{
    switch (format)
    {
    case Format::haptic:
        return readHaptic (file);
    case Format::ahap:
        return readAhap (file, read_sound, sounds);
    case Format::hjif:
        return readHjif (file);
    default:
        return readOwnClip (file);
    }
}
}   // namespace

bool isClipName (std::string_view name) noexcept
{
    const auto dot = name.rfind ('.');
    if (dot == std::string_view::npos) return false;
    const auto equals = [] (char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; };
    return std::ranges::any_of (std::array<std::string_view, 4> { "haptic", "ahap", "hjif", "json" },
                                [&] (std::string_view known) { return std::ranges::equal (name.substr (dot + 1), known, equals); });
}

Messages ClipFile::leftOut() const
{
    Messages out;
    std::ranges::copy_if (notes, std::back_inserter (out), [] (const Message& m) { return m.id != "clip/habit"; });
    return out;
}

Result<ClipFile> readClip (std::string_view bytes, std::string_view name, const ReadSound& read_sound)
{
    const auto by_name = formatOf (name);
    if (by_name == Format::none) return unknownKind (name);
    try
    {
        ClipJson file (bytes, name);
        ClipFile made;
        made.clip = readAs (by_name == Format::json ? inside (file) : by_name, file, read_sound, made.sounds);
        made.notes = file.takeNotes();
        if (const auto what = problemOf (made.clip); ! what.empty()) return Message::error ("clip/range", std::string (name), what, "correct it");
        return made;
    }
    catch (const ClipProblem& problem)
    {
        return problem.message;
    }
}

Result<ClipText> writeClip (const Clip& clip, std::string_view name)
{
    switch (formatOf (name))
    {
    case Format::haptic:
        return writeHaptic (clip);
    case Format::ahap:
        return writeAhap (clip);
    case Format::hjif:
        return writeHjif (clip);
    case Format::json:
        return writeOwnClip (clip);
    case Format::none:
        break;
    }
    return unknownKind (name);
}

namespace
{
/// The frequencies of an emphasis; its length is always two cycles here.
double readEmphasisEnd (ClipJson& file, const Spot& emphasis, std::string_view key)
{
    const auto end = file.need (emphasis, key);
    const auto frequency = file.need (end, "output_frequency");
    const double hertz = file.number (frequency, 0.1, 1e5);
    constexpr double differs = 0.05;
    if (const auto length = file.find (end, "duration_ms"))
        if (const double cycles = 1e-3 * file.number (*length) * hertz; ! (std::abs (cycles - 2.0) < 2.0 * differs))
            file.note (*length, "clip/changed", "the emphasis is " + std::to_string (cycles) + " cycles long; here it is always 2", "no action is needed");
    if (const auto shape = file.find (end, "shape"); shape && ! file.isText (end, "shape", "sine"))
        file.note (*shape, "clip/not_carried", "the shape is played as a sine", "no action is needed");
    return hertz;
}
}   // namespace

Result<Messages> readCalibration (std::string_view bytes, std::string_view name, ClipVoice& voice)
{
    try
    {
        ClipJson file (bytes, name);
        const auto& root = file.root();
        const auto continuous = file.need (root, "continuous"), emphasis = file.need (root, "emphasis");
        const auto low = file.need (continuous, "frequency_min"), high = file.need (continuous, "frequency_max");
        ClipVoice read { .lowest = file.number (low, 0.1, 1e5), .highest = file.number (high, 0.1, 1e5) };
        read.ducking = file.numberOr (continuous, "emphasis_ducking", 1.0, 0.0, 1.0);
        read.tap_lowest = readEmphasisEnd (file, emphasis, "frequency_min");
        read.tap_highest = readEmphasisEnd (file, emphasis, "frequency_max");
        for (const auto* part : { &continuous, &emphasis })
            if (const auto gain = file.find (*part, "gain"); gain && file.number (*gain) != 1.0)
                file.note (*gain, "clip/not_carried", "the gain is left out", "set the gain of the node, and the levels of its tracks");
        if (const auto fade = file.find (emphasis, "fade_out_percent"); fade && file.number (*fade) != 0.0)
            file.note (*fade, "clip/not_carried", "the fade of the emphasis is left out", "no action is needed");
        voice = read;
        return file.takeNotes();
    }
    catch (const ClipProblem& problem)
    {
        return problem.message;
    }
}

}   // namespace tactus::readers
