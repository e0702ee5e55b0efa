// SPDX-License-Identifier: MIT
#pragma once

#include <host/base/files/evemu.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/message.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace tactus::host
{

struct ConversionOptions
{
    std::string in, out;   ///< files; their extensions choose the formats
    std::string calibration {};
    double rate_hz = 0.0;   ///< of samples or rows; 0: as usual for the format
    bool split = false;     ///< an .ahap into two files
    EvemuOptions pen {};
    std::string pen_option {};   ///< one that was given; empty: none
};

/// A file that a conversion has written, and what it lacks.
struct ConvertedFile
{
    std::string name;
    Messages losses {};                        ///< what the format cannot hold
    std::size_t said = 0;                      ///< so many losses are also notes of the conversion
    std::vector<std::string> differences {};   ///< how far it is from the clip that was read, as sentences
};

/// A haptic clip in another format, or a pen recording as a trace, as `tactus convert` makes it.
struct Conversion
{
    Messages notes {};     ///< what the reader left out or guessed
    bool is_pen = false;   ///< a trace, which has rows; else a clip
    std::size_t tracks = 0, events = 0, rows = 0;
    double seconds = 0.0;
    std::vector<ConvertedFile> files {};

    Json json() const;
};

/// Throws Refusal, or UsageError for options that do not fit the files. An output that is the input is refused: output/is_input. [main thread]
Conversion convert (const ConversionOptions&);

}   // namespace tactus::host
