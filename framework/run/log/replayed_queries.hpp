// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/threads/async_query.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace tactus
{

/// Answers each query when its answer is due, except for queries that were late in the recorded run. [one thread]
class ReplayedQueries final : public QueryService
{
public:
    void add (AsyncQueryBase&) override {}
    void remove (AsyncQueryBase&) override {}
    bool isLate (bool) noexcept override { return std::ranges::binary_search (late, asked++); }

    /// Sets the late queries of the next tick: their numbers in the journal, lowest first.
    void repeat (std::span<const std::uint64_t> questions) { late.assign (questions.begin(), questions.end()); }

private:
    std::vector<std::uint64_t> late;
    std::uint64_t asked = 0;
};

}   // namespace tactus
