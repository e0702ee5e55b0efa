// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.hpp"

#include <host/code/fuse/fusion_compiler.hpp>
#include <host/code/fuse/load_fused.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

namespace tactus::bench
{

namespace
{
using host::FusedCode;

/// By key of a contest: that of the one with the plan fused.
const std::map<std::string, std::string, std::less<>> fused_keys {
    { "plan/hand", "fused/hand" },
    { "light_plan/hand", "light_fused/hand" },
    { "dry_wood_plan/hand", "dry_wood_fused/hand" },
    { "juce/plan", "juce/fused" },
    { "juce_tree100/plan", "juce_tree100/fused" },
};

/// The nodes that only the bench has: "light.speed" is tactus::bench::light::Speed.
FusedCode::Classes ownClasses (const Plan& plan)
{
    constexpr std::string_view family = "light.";
    FusedCode::Classes all;
    for (const auto& node : plan.flat().nodes)
    {
        const std::string id (node.type->info.id);
        if (! id.starts_with (family)) continue;
        auto name = id.substr (family.size());
        name.front() = static_cast<char> (std::toupper (static_cast<unsigned char> (name.front())));
        all[id] = { "tactus::bench::light::" + name, "host/tools/bench/light_nodes.hpp" };
    }
    return all;
}

/// The shared object of this code. Throws if it cannot be compiled. Compiles each code only once.
std::string objectOf (const FusedCode& code, bool quick)
{
    // Keeps the files until the program ends.
    static host::FusionCompiler compiler {
        { .optimisation = quick ? "-O0" : "-O3",
          .cache = quick ? std::filesystem::path {} : host::FusionCompiler::usualCache(),
          .flags = { "-I" TACTUS_BENCH_SOURCES } }
    };
    static std::map<std::string, std::string> known;
    const auto [object, is_new] = known.try_emplace (code.text);
    if (! is_new) return object->second;
    if (const auto started = compiler.start (code); ! started) throw std::runtime_error (started.error().text);
    for (;; std::this_thread::sleep_for (std::chrono::milliseconds (20)))
    {
        const auto done = compiler.finished();
        if (! done) continue;
        if (! *done) throw std::runtime_error (done->error().text);
        return object->second = (**done).string();
    }
}

std::unique_ptr<Variant> fuse (std::unique_ptr<Variant> variant, bool quick)
{
    auto& plan = *dynamic_cast<Planned&> (*variant).running();
    auto code = FusedCode::of (plan, ownClasses (plan));
    code.headers.insert ("tactus/node/generic.hpp");   // the nodes of the bench include it
    auto loaded = host::loadFused (objectOf (code, quick), code.objects);
    if (! loaded) throw std::runtime_error (loaded.error().text);
    plan.fuse (std::move (*loaded));
    return variant;
}

Contest fused (Contest contest, const std::string& key, bool quick)
{
    contest.key = key;
    const bool is_first = contest.first == "plan";
    (is_first ? contest.first : contest.second) = "fused";
    auto& make = is_first ? contest.make_first : contest.make_second;
    make = [plan = std::move (make), quick] { return fuse (plan(), quick); };
    make();
    return contest;
}
}   // namespace

std::vector<Contest> contests (bool quick)
{
    std::vector<Contest> all;
    for (const auto& some : { handContests, lightContests, dryWoodContests, juceContests, faustContests })
        std::ranges::move (some(), std::back_inserter (all));
    const auto planned = all.size();
    try
    {
        for (std::size_t i = 0; i < planned; ++i)
            if (const auto key = fused_keys.find (all[i].key); key != fused_keys.end()) all.push_back (fused (all[i], key->second, quick));
    }
    catch (const std::runtime_error& why)
    {
        std::fprintf (stderr, "warning: rows of fused code are missing: %s [bench/not_fused]\n", why.what());
    }
    return all;
}

}   // namespace tactus::bench
