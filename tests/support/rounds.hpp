// SPDX-License-Identifier: MIT
// How often a test draws random inputs, and how long a soak is. Sanitizers make a test ten times slower, and memory errors depend on the kind of
// input, rarely on the number of inputs: ./test.sh sets TACTUS_ROUNDS for them, in percent, as it sets max_success for RapidCheck.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace tactus::test
{
/// `usual` rounds, or TACTUS_ROUNDS percent of them, at least 1.
template <typename Number>
Number rounds (Number usual)
{
    const auto* percent = std::getenv ("TACTUS_ROUNDS");
    return percent ? std::max<Number> (1, static_cast<Number> (static_cast<double> (usual) * std::strtod (percent, nullptr) / 100.0)) : usual;
}

/// The reports of a soak: 1000 for each of TACTUS_SOAK_SECONDS, or those of a minute (fewer under a sanitizer).
inline std::uint64_t soakReports()
{
    const auto* wanted = std::getenv ("TACTUS_SOAK_SECONDS");
    return wanted != nullptr ? static_cast<std::uint64_t> (1000.0 * std::max (1.0, std::strtod (wanted, nullptr))) : rounds (std::uint64_t { 60'000 });
}
}   // namespace tactus::test
