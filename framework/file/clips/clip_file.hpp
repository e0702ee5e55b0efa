// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>
#include <tactus/kit/signal/clip.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/result.hpp>

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace tactus::readers
{

/// Recordings by the paths with which a clip file names them.
using ClipSounds = std::map<std::string, Signal>;

/// Reads a recording that a clip file names. An error is the reason why the sound is left out. The path is that of a stranger: what is read for it
/// must be below the folder of the clip.
using ReadSound = std::function<Result<Signal> (const std::string& path)>;

/// A clip that was read. The warnings name contents that a clip cannot hold, and syntax that is accepted although the format does not
/// allow it. `where` is name:line:column. Warnings of one kind are one, with a count.
struct ClipFile
{
    Clip clip {};
    Messages notes {};
    ClipSounds sounds {};           ///< that the file names, and that are in the clip
    std::string name {}, text {};   ///< of a file whose sound can be compared with what is made of it (renderFile); else empty

    /// The notes about what is not in the clip, or differs there: clip/not_carried, clip/changed, clip/clamped, clip/not_finite.
    Messages leftOut() const;
};

/// The text of a clip file, with warnings about what it could not carry. `where` is the part of the clip.
struct ClipText
{
    std::string text;
    Messages losses;
};

/// True if the extension is one of a clip file: .haptic, .ahap, .hjif or .json. [any thread]
bool isClipName (std::string_view name) noexcept;

/// Reads a clip: Meta .haptic 1, Apple AHAP, MPEG HJIF, or a clip of Tactus (.json, "format": "tactus-clip"). The extension selects the
/// format; a .json may also hold any of the others. The time is linear in the number of events. Accepts any text. Docs: docs/clips.md.
/// Error ids: clip/unknown_kind, clip/syntax, clip/missing, clip/kind, clip/range, clip/order, clip/version, clip/too_few, clip/too_large.
/// Warnings: clip/habit, and those of ClipFile::leftOut. Sounds that an AHAP names are left out if there is no ReadSound. [main thread]
[[nodiscard]] Result<ClipFile> readClip (std::string_view bytes, std::string_view name, const ReadSound& = {});

/// Writes a clip in the format of the extension. Warnings: clip/not_carried, clip/changed. Error: clip/unknown_kind. [main thread]
[[nodiscard]] Result<ClipText> writeClip (const Clip&, std::string_view name);

/// Sets what 0 and 1 mean, from an actuator calibration of Meta (.acf). Returns warnings about what a clip cannot hold. Errors as readClip.
/// [main thread]
[[nodiscard]] Result<Messages> readCalibration (std::string_view bytes, std::string_view name, ClipVoice&);

}   // namespace tactus::readers
