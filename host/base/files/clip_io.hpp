// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/clips/clip_difference.hpp>
#include <tactus/file/clips/clip_file.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// The extension of a file in lower case, such as ".haptic".
std::string extensionOf (const std::filesystem::path&);

/// True if only clips have this extension: .haptic, .ahap, .hjif or .wav. A .json may be a clip or a graph.
bool isClipExtension (const std::filesystem::path&);

/// True if the file is a clip: its extension says so, or it is a .json that can be read as a clip.
bool isClipFile (const std::filesystem::path&);

/// Reads a clip of any format: .haptic, .ahap, .hjif, .json, .wav or .csv. Ids: those of readClip, readWav, readTable and clipOfTable,
/// file/unreadable, clip/unknown_kind. Recordings that an .ahap names are read too, unless `as_node`: signal.clip reads no file but its own. [main thread]
Result<readers::ClipFile> loadClip (const std::filesystem::path&, bool as_node = false);

/// The difference between a part of the clip in the file and the clip that was saved. Both are rendered.
struct ClipLoss
{
    std::string part {};   ///< "channel 1", "all channels, the envelope alone"
    readers::ChannelDifference difference {};
    std::string why {};   ///< what was compared, or why it differs; may be empty
};

/// The result of saving a clip: what was lost.
struct SavedClip
{
    Messages losses;                     ///< what the format cannot hold
    std::vector<ClipLoss> differences;   ///< only those that can be measured
    bool is_mixed = false;               ///< all channels were added up

    std::vector<readers::SampleDifference> samples {};   ///< of the signal itself
    std::string compared {};                             ///< what the samples were compared with, and how much of it; a part of a sentence
};

/// Writes a clip in the format of the extension: .haptic, .ahap, .hjif, .json, .wav or the rows of a clip in a .csv. Reads it back to
/// find out what was lost. `rate_hz` is for a .wav; 0: the rate of the recording that the clip came from, or 8 kHz. Samples of a .wav are from -1 to 1:
/// if the signal exceeds 1, all channels are divided by the same factor, and the losses say so (clip/changed). An .ahap is compared twice: what it holds,
/// envelope and transients apart, and how a phone plays it. With `source`, the file that the clip was read from, the samples of what was written are compared
/// with a rendering of that file which shares no rule with its reader, and its notes about what was left out are losses. Ids: those of writeClip, WavWriter
/// and TableWriter, clip/too_large, clip/too_few. [main thread]
Result<SavedClip> saveClip (const Clip&, const std::filesystem::path&, double rate_hz = 0.0, const readers::ClipFile* source = nullptr);

/// The losses as sentences: each thing that the format cannot hold, and how far the rendered clip differs. Never empty.
std::vector<std::string> lossReport (const SavedClip&);

/// The differences only, as sentences. Never empty.
std::vector<std::string> differenceReport (const SavedClip&);

/// Refuses a rendering that is too large. Id: clip/too_large.
Result<> checkRendered (const Clip&, double rate_hz, const std::string& remedy);

}   // namespace tactus::host
