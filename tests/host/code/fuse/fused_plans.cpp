// SPDX-License-Identifier: MIT
#include "fused_plans.hpp"
#include "support/waiting.hpp"

#include <host/code/fuse/bitcode.hpp>
#include <host/code/fuse/fusion_compiler.hpp>
#include <host/code/fuse/load_fused.hpp>
#include <host/code/generate/sources/code.hpp>
#include <support/sketch.hpp>

#include <catch2/catch.hpp>

#include <filesystem>

namespace tactus::test
{

namespace
{
/// Waits for compiled code. Keeps the files until the process ends.
Result<std::filesystem::path> compile (const host::FusedCode& code)
{
    static host::FusionCompiler compiler { { .optimisation = "-O1" } };
    if (auto started = compiler.start (code); ! started) return started.error();
    std::optional<Result<std::filesystem::path>> done;
    eventually (std::chrono::milliseconds (5), looks_at_compiler, [&] { return (done = compiler.finished()).has_value(); });
    return std::move (done.value());
}
}   // namespace

std::string compiledFusion (const host::FusedCode& code)
{
    const auto done = compile (code);
    INFO ((done ? std::string {} : done.error().text));
    REQUIRE (done);
    return (*done).string();
}

std::shared_ptr<const FusedTick> fusedByLlvm (const Plan& plan)
{
    auto code = host::FusedCode::wiringOf (plan);
    const auto object = compile (code);
    if (! object && object.error().id == "fuse/no_llvm") return nullptr;
    INFO ((object ? std::string {} : object.error().text));
    REQUIRE (object);
    auto loaded = host::loadFused (*object, std::move (code.objects));
    INFO ((loaded ? std::string {} : loaded.error().text));
    REQUIRE (loaded);
    return std::move (*loaded);
}

bool hasLlvm()
{
    static const bool has_bitcode = ! host::allBitcode().empty();
    if (! has_bitcode) return false;
    const auto plan = Sketch {}.node ("a", "filter.one_pole").compile ({ .records = { "a.out" } }).plan;
    return fusedByLlvm (*plan) != nullptr;
}

void FusedPlans::add (const Plan& plan)
{
    auto code = host::FusedCode::of (plan);
    REQUIRE_FALSE (code.text.empty());
    const auto number = std::to_string (objects.size());
    const auto body = code.text.find ("\n\n");   // after the includes
    bodies += "namespace plan_" + number + "\n{\n"
              + host::filled (code.text.substr (body), { { std::string (host::FusedCode::function) + " ", "fused_" + number + " " } }) + "}\n";
    all.headers.insert (code.headers.begin(), code.headers.end());
    objects.push_back (std::move (code.objects));
}

std::vector<std::shared_ptr<const FusedTick>> FusedPlans::load()
{
    for (const auto& header : all.headers)
        all.text += "#include <" + header + ">\n";
    all.text += bodies;
    const auto object = compiledFusion (all);
    std::vector<std::shared_ptr<const FusedTick>> loaded;
    for (std::size_t i = 0; i < objects.size(); ++i)
    {
        auto one = host::loadFused (object, std::move (objects[i]), ("fused_" + std::to_string (i)).c_str());
        REQUIRE (one);
        loaded.push_back (std::move (*one));
    }
    return loaded;
}

}   // namespace tactus::test
