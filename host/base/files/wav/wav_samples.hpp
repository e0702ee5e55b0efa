// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_core/juce_core.h>

#include <memory>
#include <string>

namespace tactus::host
{

/// The samples of a WAV file, and how many bytes of them the file has. Its header may claim more.
struct WavSamples
{
    std::unique_ptr<juce::InputStream> stream;
    juce::int64 bytes = 0;
    std::string why {};   ///< there is no stream, as a part of a sentence
};

/// The WAV file without its metadata: a header with only the format and the size of the samples, then the samples, which are read
/// from the file when they are needed. JUCE's reader parses all metadata, and deeply nested XML overflows its stack. The sizes are
/// those that the file claims; if it claims none, as streams do, all bytes to its end are samples. 64-bit floats, which JUCE does not read,
/// become 32-bit ones. The stream is null if the file is not a WAV, or its format is neither integers nor floats; then there is a reason. [any thread]
WavSamples samplesOnly (std::unique_ptr<juce::InputStream> wav);

}   // namespace tactus::host
