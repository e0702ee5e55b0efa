// SPDX-License-Identifier: GPL-3.0-or-later
#include "running.hpp"

#include <host/code/fuse/bitcode.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <map>
#include <string>

using namespace tactus::test;

namespace
{
/// Sets variables of the environment until the test ends.
class Environment
{
public:
    explicit Environment (const std::map<std::string, std::string>& variables)
    {
        for (const auto& [name, value] : variables)
        {
            if (const char* old = std::getenv (name.c_str())) before[name] = old;
            names.push_back (name);
            setenv (name.c_str(), value.c_str(), 1);
        }
    }

    ~Environment()
    {
        for (const auto& name : names)
            before.contains (name) ? setenv (name.c_str(), before[name].c_str(), 1) : unsetenv (name.c_str());
    }

    Environment (const Environment&) = delete;
    Environment& operator= (const Environment&) = delete;

private:
    std::vector<std::string> names;
    std::map<std::string, std::string> before;
};

const auto* const dry_wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";
}   // namespace

TEST_CASE ("play --fuse without LLVM and a compiler says so, and plays on", "[cli][fuse]")
{
    const Scratch home;
    const Environment none { { { "CXX", "/no/such/compiler" }, { "TACTUS_FUSE_LLVM", "/no/such/program" }, { "TACTUS_HOME", home.path ("home") } } };
    const auto ran = runTactus ({ "play", dry_wood, "--fuse", "--osc", "off", "--duration", "0.1" });
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.err.find ("[fuse/no_compiler]") != std::string::npos);
    CHECK (ran.err.find (" ticks") != std::string::npos);
}

TEST_CASE ("play --fuse needs no compiler where LLVM is installed", "[cli][fuse]")
{
    if (tactus::host::allBitcode().empty())
    {
        WARN ("skipped: this was built without clang");
        return;
    }
    const Scratch home;
    const Environment none { { { "CXX", "/no/such/compiler" }, { "TACTUS_HOME", home.path ("home") } } };
    Running play { { "play", dry_wood, "--fuse", "--osc", "off", "--duration", "600" } };
    const bool is_fused = play.says ("steps in");
    const auto ran = play.stop();
    INFO (ran.err);
    if (ran.err.find ("no LLVM") != std::string::npos)
    {
        WARN ("skipped: LLVM is not installed");
        return;
    }
    CHECK (is_fused);
    CHECK (ran.err.find ("by LLVM") != std::string::npos);
}
