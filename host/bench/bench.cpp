// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.hpp"
#include "edited.hpp"
#include "fused.hpp"
#include "juce_variants.hpp"
#include "one_poles.hpp"

#include <algorithm>

namespace tactus::bench
{

namespace
{
constexpr int block = 200;   // ticks per round: about 100 us, which is shorter than a time slice

std::function<void (int)> blocksOf (const Contest& contest, const Contest::Make& make)
{
    return [&inputs = contest.inputs, variant = std::shared_ptr<Variant> (make())] (int round) {
        auto at = static_cast<std::size_t> (round) * block % inputs.size();
        for (int k = 0; k < block; ++k)
        {
            variant->tick (inputs[at].data());
            if (++at == inputs.size()) at = 0;
        }
    };
}

std::function<void (int)> compiling (int nodes, int times)
{
    return [g = shuffled (treeOfOnePoles (nodes)), times] (int) {
        for (int i = 0; i < times; ++i)
            compile (g, catalogue());
    };
}
}   // namespace

bool Results::agree() const
{
    return std::ranges::all_of (agreements, [] (const Agreed& a) { return a.found.agree; });
}

void agree (Results& results, bool quick)
{
    for (auto& contest : withFused (contests(), quick))
    {
        const auto found = compare (contest);
        results.agreements.push_back ({ std::move (contest), found });
    }
}

void time (Results& results, bool quick, bool quiet)
{
    const auto add = [&] (Pair pair) { results.pairs.push_back (std::make_unique<Pair> (std::move (pair))); };

    for (const auto& [contest, found] : results.agreements)
        add ({ contest.key, blocksOf (contest, contest.make_first), blocksOf (contest, contest.make_second), block, block, quick ? 40 : 4000 });

    const auto rebuild = [edit = juceEdits (shuffled (treeOfOnePoles (1000)))] (int) { edit(); };
    add ({ "juce_rebuild1000/compile1000", rebuild, compiling (1000, 20), 1.0, 20.0, quick ? 1 : 15 });
    add ({ "compile10000/compile1000", compiling (10000, 1), compiling (1000, 10), 1.0, 10.0, quick ? 2 : 60 });

    // A tick of 10 000 nodes takes about 100 us, so a round is one tick of each kind.
    const auto edited = std::make_shared<Edited> (shuffled (treeOfOnePoles (10000)));
    const auto tick = [edited] (int) { edited->tick(); };
    const auto takeover = [edited] (int) { edited->takeOver(); };
    const auto knob = [edited] (int) { edited->turn(); };
    add ({ "takeover10000/tick", takeover, tick, 1.0, 1.0, quick ? 4 : 400, [edited] (int) { edited->prepareTakeover(); } });
    add ({ "knob10000/tick", knob, tick, 1.0, 1.0, quick ? 4 : 1000 });

    measure (results.pairs, quiet);
    results.memory = memoryPerNode();
}

}   // namespace tactus::bench
