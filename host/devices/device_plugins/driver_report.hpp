// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_plugin.h>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <string_view>

namespace tactus::host
{

/// Receives what a driver says, without allocating: its functions are called a thousand times a second. Text beyond the room is lost.
class DriverReport
{
public:
    DriverReport() noexcept : sink { sizeof sink, this, &put } {}
    DriverReport (const DriverReport&) = delete;
    DriverReport& operator= (const DriverReport&) = delete;

    const tactus_plugin_report* to() const noexcept { return &sink; }
    void clear() noexcept { length = 0; }

    /// The text of the driver, in one line, or another one if it said nothing.
    std::string text (std::string_view otherwise = "it does not say why") const
    {
        auto all = length == 0 ? std::string (otherwise) : printable ({ said.data(), length });
        std::ranges::replace (all, '\n', ' ');
        return all;
    }

private:
    static void put (void* context, const char* text, std::size_t size) noexcept
    {
        auto& report = *static_cast<DriverReport*> (context);
        const auto part = text != nullptr ? std::min (size, report.said.size() - report.length) : 0;
        if (part > 0) std::memcpy (report.said.data() + report.length, text, part);
        report.length += part;
    }

    tactus_plugin_report sink;
    std::size_t length = 0;
    std::array<char, 1000> said;   // enough for what a system says about each name of a library that it cannot open
};

}   // namespace tactus::host
