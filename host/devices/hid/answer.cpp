// SPDX-License-Identifier: MIT
#include "answer.hpp"
#include "bits.hpp"

namespace tactus::host::hid
{
namespace
{
std::optional<std::uint32_t> read (const Bits& bits, std::span<const std::uint8_t> report)
{
    if (bits.end() > 8 * report.size()) return {};
    return bitsAt (bits, report);
}
}   // namespace

Result<std::optional<std::uint32_t>> numberIn (const Answer& answer, std::span<const std::uint8_t> report)
{
    if (answer.id && (report.empty() || report.front() != *answer.id)) return std::nullopt;
    for (const auto& refusal : answer.refusals)
        if (read (refusal.bits, report) == refusal.raw) return refusal.means;
    if (answer.success && read (answer.success->bits, report) != answer.success->raw) return std::nullopt;
    const auto number = read (answer.number, report);
    return number == 0u ? std::nullopt : number;
}

}   // namespace tactus::host::hid
