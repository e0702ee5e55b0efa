// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contest.hpp"
#include "memory.hpp"
#include "pair.hpp"

#include <map>

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

/// Whether all variants agree; run before anything is timed. [message thread]
void agree (Results&);

/// Times them (docs/bench.md). `quick` takes few rounds, enough to see that it works. [message thread]
void time (Results&, bool quick, bool quiet);

}   // namespace tactus::bench
