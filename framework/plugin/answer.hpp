// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_plugin.h>

#include <string>

namespace tactus::plugin
{

/// Collects the text that a hook reports.
class Answer
{
public:
    Answer() noexcept : sink { sizeof sink, this, &put } {}
    Answer (const Answer&) = delete;
    Answer& operator= (const Answer&) = delete;

    const tactus_plugin_report* report() const noexcept { return &sink; }
    const std::string& text() const noexcept { return all; }
    bool isWhole() const noexcept { return is_whole; }   ///< false: there was no memory for a part of it

private:
    static void put (void* context, const char* text, std::size_t length) noexcept
    {
        auto& answer = *static_cast<Answer*> (context);
        try
        {
            answer.all.append (text, length);
        }
        catch (...)   // no memory for the text: only the text is lost, not the result of the hook
        {
            answer.is_whole = false;
        }
    }

    tactus_plugin_report sink;
    std::string all;
    bool is_whole = true;
};

}   // namespace tactus::plugin
