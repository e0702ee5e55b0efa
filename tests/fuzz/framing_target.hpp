// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/report/framing.hpp>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <vector>

namespace tactus::fuzz
{

/// The reports in these bytes if they come in pieces of such a size, with or without pauses between them.
inline std::vector<host::hid::Bytes> framed (host::hid::Framing framing, const std::vector<host::hid::FrameReader::Shape>& shapes, std::string_view bytes,
                                             std::size_t piece, bool pauses = false)
{
    std::vector<host::hid::Bytes> reports;
    host::hid::FrameReader reader (framing, shapes);
    const auto takeAll = [&] {
        while (const auto report = reader.next())
            reports.emplace_back (report->begin(), report->end());
    };
    const auto all = bytes.size();
    while (! bytes.empty())
    {
        const auto room = reader.room();
        if (room.empty()) std::abort();
        const auto size = std::min ({ piece, room.size(), bytes.size() });
        std::memcpy (room.data(), bytes.data(), size);
        bytes.remove_prefix (size);
        reader.arrived (size);
        takeAll();
        if (pauses) reader.pause();
        takeAll();
    }
    std::size_t passed_on = 0;
    for (const auto& r : reports)
        passed_on += r.size();
    if (reader.counts().frames != reports.size() || passed_on + reader.counts().bytes > all) std::abort();
    return reports;
}

/// Looks for reports in the bytes, with each framing. What is found does not depend on how the bytes come, and has an allowed length. Aborts
/// otherwise.
inline void tryFraming (std::string_view data)
{
    using namespace host::hid;
    const std::vector<FrameReader::Shape> one { { {}, 6, 6, { { Bits { .at = 0 }, 0x54 }, { Bits { .at = 8 }, 1 } } } };
    const std::vector<FrameReader::Shape> several { { std::uint8_t { 1 }, 4, 4, { { Bits { .at = 8 }, 7 } } }, { std::uint8_t { 2 }, 9, 20, {} } };
    for (const auto framing : { Framing::none, Framing::cobs, Framing::length, Framing::dualpanto, Framing::answer })
        for (const auto& shapes : { one, several })
        {
            const auto whole = framed (framing, shapes, data, data.size());
            if (whole != framed (framing, shapes, data, 1) || whole != framed (framing, shapes, data, 7)) std::abort();
            framed (framing, shapes, data, 3, true);
            if (framing == Framing::cobs) continue;   // of any length; the decoder refuses wrong ones
            for (const auto& report : whole)
                if (std::ranges::none_of (shapes, [&] (const auto& s) { return report.size() >= s.length && report.size() <= s.longest; })) std::abort();
        }
}

}   // namespace tactus::fuzz
