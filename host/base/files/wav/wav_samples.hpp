// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_core/juce_core.h>

#include <memory>

namespace tactus::host
{

/// The WAV file without its metadata: a header with only the format and the size of the samples, then the samples, which are read
/// from the file when they are needed. JUCE's reader parses all metadata, and deeply nested XML overflows its stack. The sizes are
/// those that the file claims. Null if the file is not a WAV, or its format is neither integers nor floats. [any thread]
std::unique_ptr<juce::InputStream> samplesOnly (std::unique_ptr<juce::InputStream> wav);

}   // namespace tactus::host
