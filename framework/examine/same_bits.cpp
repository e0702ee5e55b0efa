// SPDX-License-Identifier: MIT
#include "examination.hpp"
#include "parts.hpp"

#include <tactus/kit/state_archive.hpp>
#include <tactus/text/caught.hpp>

#include <algorithm>
#include <bit>
#include <latch>
#include <optional>
#include <thread>

namespace tactus::examine
{

namespace
{
/// A run of one instance that depends on nothing but the seed.
class RandomRun
{
public:
    RandomRun (const NodeType& type, unsigned seed) : dice (seed), rig (type)
    {
        randomSettings (rig, dice);
        randomParams (rig, dice, Span::usual);
        rig.prepare();
    }

    void tick()
    {
        if (dice.once_in (20)) randomParams (rig, dice, Span::usual);
        randomTameInputs (rig, dice);
        rig.tick();
        for (std::size_t i = 0; i < rig.outputs.size(); ++i)
            all.push_back (rig.out (i));
        const auto effort = rig.effort();
        all.insert (all.end(), effort.force.data(), effort.force.data() + 3);
    }

    const std::vector<double>& outputs() const noexcept { return all; }

private:
    NodeDice dice;
    Rig rig;
    std::vector<double> all;
};

std::vector<double> run (const NodeType& type, unsigned seed, int ticks)
{
    RandomRun one { type, seed };
    for (int k = 0; k < ticks; ++k)
        one.tick();
    return one.outputs();
}

constexpr unsigned other = 0x9e3779b9u;   // gives the second instance a different seed
}   // namespace

bool sameBits (const std::vector<double>& a, const std::vector<double>& b)
{
    const auto bits = [] (double v) { return std::bit_cast<std::uint64_t> (v); };
    return std::ranges::equal (a, b, {}, bits, bits);
}

std::string repeatFault (const NodeType& type, unsigned seed)
{
    return sameBits (run (type, seed, 50), run (type, seed, 50)) ? "" : "two fresh instances give different bits for the same inputs";
}

std::string instanceFault (const NodeType& type, unsigned seed)
{
    const auto first_alone = run (type, seed, 50), second_alone = run (type, seed ^ other, 50);
    RandomRun first { type, seed }, second { type, seed ^ other };
    for (int k = 0; k < 50; ++k)
    {
        first.tick();
        second.tick();
    }
    const bool same = sameBits (first.outputs(), first_alone) && sameBits (second.outputs(), second_alone);
    return same ? "" : "two instances that tick in turn give different bits than each alone: they share state";
}

std::string threadFault (const NodeType& type, unsigned seed)
{
    constexpr int ticks = 500;
    const auto first_alone = run (type, seed, ticks), second_alone = run (type, seed ^ other, ticks);
    RandomRun first { type, seed }, second { type, seed ^ other };
    std::latch ready { 2 };
    const auto play = [&ready] (RandomRun& one) {
        ready.arrive_and_wait();
        for (int k = 0; k < ticks; ++k)
            one.tick();
    };
    Result<> played {};
    std::thread there ([&] { played = caught ("a tick", [&] { play (second); }); });
    const auto played_here = caught ("a tick", [&] { play (first); });
    there.join();
    if (! played || ! played_here) return sentence ((played ? played_here : played).error());
    const bool same = sameBits (first.outputs(), first_alone) && sameBits (second.outputs(), second_alone);
    return same ? "" : "two instances that tick in two threads give different bits than each alone: they share state";
}

std::string noAdopt (const NodeType& type) { return type.adopt ? "" : "it has no `adopt`"; }

std::string adoptFault (const NodeType& type, unsigned seed)
{
    NodeDice dice { seed };
    Rig old = prepared (type), young = prepared (type);
    for (int k = 0; k < 50; ++k)
    {
        randomTameInputs (old, dice);
        old.tick();
    }
    young.adopt (old);
    for (int k = 0; k < 50; ++k)
    {
        randomTameInputs (old, dice);
        young.in = old.in;
        old.tick();
        young.tick();
        if (! sameBits (old.outs(), young.outs())) return say ("tick ", k + 1, " after `adopt` gives different bits than the old instance");
    }
    return {};
}

namespace
{
/// A rig whose node can also be saved.
struct Kept
{
    explicit Kept (const NodeType& of) : type (of)
    {
        type.make = [this, &of] { return node = of.make(); };
        rig.emplace (type);
        rig->prepare();
    }

    Kept (const Kept&) = delete;
    Kept& operator= (const Kept&) = delete;

    std::string restore (std::span<const std::byte> bytes)
    {
        StateArchive archive { bytes };
        Stage::enter ("restore");
        type.serialize (node.get(), archive);
        if (! archive.isAtEnd()) archive.refuse ("has bytes that nothing reads");
        return archive.refusal();
    }

    NodeType type;
    std::shared_ptr<void> node {};
    std::optional<Rig> rig {};
};
}   // namespace

std::string noState (const NodeType& type) { return type.serialize ? "" : "its state cannot be saved"; }

std::string stateFault (const NodeType& type, unsigned seed)
{
    NodeDice dice { seed };
    Kept one { type }, clone { type };
    auto &saved = *one.rig, &restored = *clone.rig;
    const auto tickBoth = [&] (bool same) {
        randomTameInputs (saved, dice);
        if (same)
            restored.in = saved.in;
        else
            randomTameInputs (restored, dice);
        saved.tick();
        restored.tick();
    };
    for (int k = 0; k < 50; ++k)
        tickBoth (false);
    std::vector<std::byte> bytes;
    StateArchive archive { bytes };
    Stage::enter ("save");
    type.serialize (one.node.get(), archive);
    if (archive.isRefused()) return archive.refusal();
    if (const auto why = clone.restore (bytes); ! why.empty()) return "its own state is refused: " + why;
    for (int k = 0; k < 200; ++k)
    {
        tickBoth (true);
        if (! sameBits (saved.outs(), restored.outs())) return say ("tick ", k + 1, " after a state was restored gives other bits than the saved instance");
    }
    for (int k = 0; k < 10 && ! bytes.empty(); ++k)
    {
        auto damaged = bytes;
        for (int n = 0; n < 4; ++n)
            damaged[at (dice.below (static_cast<int> (damaged.size())))] = static_cast<std::byte> (dice.below (256));
        const auto cut_off = std::span (damaged).first (at (dice.below (static_cast<int> (damaged.size()))));
        if (clone.restore (cut_off).empty()) return "a state that is cut off is not refused";
        if (! clone.restore (damaged).empty() && ! clone.restore (bytes).empty()) return "its own state is refused after a damaged one";   // as a run does
        tickBoth (false);
    }
    return {};
}

std::uint64_t fingerprint (const NodeType& type, unsigned seed)
{
    std::uint64_t sum = 0xcbf29ce484222325u;   // FNV-1a, over words instead of bytes
    for (const double v : run (type, seed, 200))
        sum = (sum ^ std::bit_cast<std::uint64_t> (v)) * 0x100000001b3u;
    return sum;
}

}   // namespace tactus::examine
