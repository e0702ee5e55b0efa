// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contest.hpp"
#include "memory.hpp"
#include "pair.hpp"

#include <memory>
#include <vector>

namespace tactus::bench
{

struct Results
{
    struct Agreed
    {
        Contest contest;
        Agreement found;
    };

    std::vector<Agreed> agreements;
    std::vector<std::unique_ptr<Pair>> pairs;
    Memory memory;

    bool agree() const;
};

/// Compares the outputs of all variants. Runs before anything is timed. `quick` compiles fused code without optimisation. [message thread]
void agree (Results&, bool quick);

/// Times the variants (docs/bench.md). `quick` runs only a few rounds, enough to see that it works. [message thread]
void time (Results&, bool quick, bool quiet);

}   // namespace tactus::bench
