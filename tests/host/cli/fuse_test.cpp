// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>

using tactus::test::runTactus;

TEST_CASE ("play --fuse without a compiler says so, and plays on", "[cli][fuse]")
{
    const char* compiler = std::getenv ("CXX");
    const std::string before = compiler != nullptr ? compiler : "";
    setenv ("CXX", "/no/such/compiler", 1);
    const auto ran = runTactus ({ "play", TACTUS_SOURCE_DIR "/graphs/dry_wood.json", "--fuse", "--osc", "off", "--duration", "0.1" });
    compiler != nullptr ? setenv ("CXX", before.c_str(), 1) : unsetenv ("CXX");
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.err.find ("[fuse/no_compiler]") != std::string::npos);
    CHECK (ran.err.find (" ticks") != std::string::npos);
}
