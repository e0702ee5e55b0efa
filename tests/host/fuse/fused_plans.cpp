// SPDX-License-Identifier: GPL-3.0-or-later
#include "fused_plans.hpp"

#include <host/fuse/fusion_compiler.hpp>
#include <host/fuse/load_fused.hpp>
#include <host/generate/code.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <thread>

namespace tactus::test
{

std::string compiledFusion (const host::FusedCode& code)
{
    static host::FusionCompiler compiler { { .optimisation = "-O1" } };   // keeps the files until the process ends
    const auto started = compiler.start (code);
    INFO ((started ? std::string {} : started.error().text));
    REQUIRE (started);
    for (;;)
    {
        if (const auto done = compiler.finished())
        {
            INFO ((*done ? std::string {} : done->error().text));
            REQUIRE (*done);
            return (**done).string();
        }
        std::this_thread::sleep_for (std::chrono::milliseconds (5));
    }
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
