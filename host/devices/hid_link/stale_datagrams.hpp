// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/bits.hpp>
#include <host/devices/hid/profile.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tactus::host::hid
{

/// Finds the datagrams that come late or twice, by the sequence numbers of the profile's input reports. A device that has restarted counts from
/// an earlier number: so after so many late ones in a row that a network does not do that, they are passed on. [one thread]
class StaleDatagrams
{
public:
    static constexpr int most_in_a_row = 16;

    explicit StaleDatagrams (const Profile& p)
    {
        for (const auto& report : p.inputs)
        {
            const auto field = std::ranges::find (report.fields, report.sequence, &InputField::name);
            if (! report.sequence.empty() && field != report.fields.end()) numbers.push_back ({ report.id, report.length, field->bits });
        }
    }

    /// True if the report must be dropped: its number is not after that of the last one that was passed on. A report without a number never is.
    bool isStale (std::span<const std::uint8_t> report) noexcept
    {
        for (auto& n : numbers)
        {
            if (report.size() < n.length || (n.id && report.front() != *n.id)) continue;
            const auto now = bitsAt (n.bits, report);
            const auto behind = (n.last.value_or (now - 1) - now) & static_cast<std::uint32_t> (maskOf (n.bits));
            const bool is_late = behind <= static_cast<std::uint32_t> (maskOf (n.bits)) / 2;
            n.in_a_row = is_late ? n.in_a_row + 1 : 0;
            if (is_late && n.in_a_row <= most_in_a_row) return true;
            n.in_a_row = 0;
            n.last = now;
            return false;
        }
        return false;
    }

private:
    struct Number
    {
        std::optional<std::uint8_t> id;
        std::size_t length = 0;
        Bits bits;
        std::optional<std::uint32_t> last {};
        int in_a_row = 0;
    };

    std::vector<Number> numbers;
};

}   // namespace tactus::host::hid
