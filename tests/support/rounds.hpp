// SPDX-License-Identifier: MIT
// How often a test draws random inputs. Sanitizers make a test ten times slower, and memory errors depend on the kind of input,
// rarely on the number of inputs: ./test.sh sets TACTUS_ROUNDS for them, in percent, as it sets max_success for RapidCheck.
#pragma once

#include <algorithm>
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
}   // namespace tactus::test
