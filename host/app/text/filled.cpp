// SPDX-License-Identifier: GPL-3.0-or-later
#include "filled.hpp"

#include <mutex>
#include <set>

namespace tactus::host
{

juce::String filledWith (const juce::String& text, std::span<const juce::String> values)
{
    juce::String all;
    for (int at = 0;;)
    {
        const int sign = text.indexOfChar (at, '%');
        const int n = sign < 0 ? 0 : text[sign + 1] - '0';
        const bool is_place = n >= 1 && n <= static_cast<int> (values.size());
        all << text.substring (at, sign < 0 ? text.length() : sign + (is_place ? 0 : 1));
        if (sign < 0) return all;
        if (is_place) all << values[static_cast<std::size_t> (n - 1)];
        at = sign + (is_place ? 2 : 1);
    }
}

std::string_view lasting (const juce::String& text)
{
    static std::mutex lock;
    static std::set<std::string> texts;
    const std::scoped_lock guard (lock);
    return *texts.insert (text.toStdString()).first;
}

}   // namespace tactus::host
