// SPDX-License-Identifier: GPL-3.0-or-later
#include "contest.hpp"
#include "contacts.hpp"
#include "dry_wood.hpp"
#include "exported.hpp"
#include "faust_chain.hpp"
#include "handwritten.hpp"
#include "juce_variants.hpp"
#include "light.hpp"
#include "one_poles.hpp"
#include "planned.hpp"
#include "reference.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace tactus::bench
{

namespace
{
std::vector<Contest::Row> strokeRows (const graph::Graph& g)
{
    std::vector<Contest::Row> rows;
    for (const auto& p : strokeOver (g))
        rows.push_back ({ p.x(), p.y(), p.z() });
    return rows;
}

/// One second of a tone that rises from 0 Hz to 1 kHz.
std::vector<Contest::Row> chirp()
{
    constexpr int ticks = 4000;
    std::vector<Contest::Row> rows;
    for (int k = 0; k < ticks; ++k)
        rows.push_back ({ std::sin (0.25 * 3.0 * k * k / ticks) });
    return rows;
}

Contest::Make planOf (graph::Graph g)
{
    return [g = std::move (g)] { return std::make_unique<Planned> (g, g.root.find ("p0") ? endsOf (g) : CompileOptions {}); };
}

bool sameBits (double a, double b) { return std::bit_cast<std::uint64_t> (a) == std::bit_cast<std::uint64_t> (b); }
}   // namespace

std::vector<Contest> contests()
{
    constexpr int poles = 100;
    const auto tree = treeOfOnePoles (poles), chain = chainOfOnePoles (poles);
    const std::string juce = "JUCE AudioProcessorGraph", plan = "plan", hand = "hand-written", exported = "export";
    const auto stroke = strokeRows (reference());
    const auto lightPlan = [] { return std::make_unique<Planned> (lightGraph(), CompileOptions {}, lightTypes()); };
    std::vector<Contest> all {
        { "plan/hand", plan, hand, "reference graph", planOf (reference()), handwritten, stroke },
        { "light_plan/hand", plan, hand, "reference graph with light kernels", lightPlan, lightByHand, stroke },
        { "dry_wood_plan/hand", plan, hand, "dry wood", planOf (dryWood()), dryWoodByHand, strokeRows (dryWood()), 1e-12 },
        { "export/hand", exported, hand, "reference graph and guard", exportedReference, handwrittenWithGuard, stroke },
        { "juce/plan", juce, plan, "reference graph", juceReference, planOf (reference()), stroke },
        { "juce_tree100/plan", juce, plan, "tree of 100 one-poles", [tree] { return juceOnePoles (tree); },
          planOf (tree), chirp() },
        { "plan/faust_chain100", plan, "Faust", "chain of 100 one-poles", planOf (chain), [] { return std::make_unique<FaustVariant>(); },
          chirp(), 1e-12 },
        { "export/faust_chain100", exported, "Faust", "chain of 100 one-poles", exportedChain, [] { return std::make_unique<FaustVariant>(); },
          chirp(), 1e-12 },
    };
    constexpr std::size_t lanes = 4;   // of AVX2
    if (widestLanes() >= lanes)
        all.push_back ({ "simd64/scalar64", "lanes", "one by one", "plane, friction and grating for 64 contacts", [] { return manyContacts (lanes); },
                         [] { return manyContacts (1); }, stroke });
    else
        std::fprintf (stderr, "note: this processor has no AVX2, so simd64/scalar64 is skipped\n");
    return all;
}

Agreement compare (const Contest& contest)
{
    const auto first = contest.make_first(), second = contest.make_second();
    Agreement found { .agree = true };
    for (const auto& row : contest.inputs)
    {
        first->tick (row.data());
        second->tick (row.data());
        const auto a = first->outputs(), b = second->outputs();
        found.agree = found.agree && a.size() == b.size();
        for (std::size_t i = 0; i < std::min (a.size(), b.size()); ++i, ++found.values)
        {
            const double apart = std::abs (a[i] - b[i]);
            found.worst = std::max (found.worst, apart);
            found.agree = found.agree && (contest.tolerance > 0.0 ? apart <= contest.tolerance : sameBits (a[i], b[i]));
        }
    }
    return found;
}

}   // namespace tactus::bench
