// SPDX-License-Identifier: GPL-3.0-or-later
#include "typeface.hpp"

#include "typeface_data.hpp"

namespace tactus::host
{

juce::Typeface::Ptr regularTypeface()
{
    const auto data = regularTypefaceData();
    return juce::Typeface::createSystemTypefaceFor (data.data(), data.size());
}

juce::Typeface::Ptr boldTypeface()
{
    const auto data = boldTypefaceData();
    return juce::Typeface::createSystemTypefaceFor (data.data(), data.size());
}

}   // namespace tactus::host
