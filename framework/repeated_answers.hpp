// SPDX-License-Identifier: MIT
#pragma once

#include "slow_question.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace tactus
{

/// Answers when answers are due, but for those that were late in an earlier run. [one thread]
class RepeatedAnswers final : public SlowAnswers
{
public:
    void add (Asker&) override {}
    void remove (Asker&) override {}
    bool isLate (bool) noexcept override { return std::ranges::binary_search (late, asked++); }

    /// What the journal was told of the tick that comes next, lowest first.
    void repeat (std::span<const std::uint64_t> questions) { late.assign (questions.begin(), questions.end()); }

private:
    std::vector<std::uint64_t> late;
    std::uint64_t asked = 0;
};

}   // namespace tactus
