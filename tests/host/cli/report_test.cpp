// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <filesystem>

#include <sys/stat.h>
#include <unistd.h>

using namespace tactus::test;

namespace
{
Ran reportWith (const Scratch& home) { return runProgram ("/usr/bin/env", { "TACTUS_HOME=" + home.path (""), TACTUS_PROGRAM, "report" }); }
}   // namespace

TEST_CASE ("a report has what an answer needs, and no names", "[cli]")
{
    const Scratch home;
    const auto ran = reportWith (home);
    INFO (ran.out);
    CHECK (ran.status == 0);
    CHECK (ran.err.empty());
    for (const auto* fact : { "Tactus: 0.", "compiler: ", "JUCE 7", "Eigen 3.", "hidapi 0.", "node types: ", "kernel: ", "processors: ", "real time: ",
                              "HID device", "last failsafe: none\n" })
    {
        INFO (fact);
        CHECK (ran.out.find (fact) != std::string::npos);
    }

    std::array<char, 256> computer {};
    REQUIRE (::gethostname (computer.data(), computer.size() - 1) == 0);
    if (const std::string name = computer.data(); name.size() > 3) CHECK (ran.out.find (name) == std::string::npos);
    CHECK (ran.out.find (home.path ("")) == std::string::npos);
    CHECK (ran.out.find ("/home") == std::string::npos);
    CHECK (ran.out.find ("serial") == std::string::npos);
}

TEST_CASE ("a report shows the last failsafe, and survives what stands in its place", "[cli]")
{
    const Scratch home;
    const auto note = home.write ("last_failsafe.txt", "2026-11-24T21:05:07Z the program did not respond\nmore");
    CHECK (reportWith (home).out.find ("last failsafe: 2026-11-24T21:05:07Z the program did not respond\n") != std::string::npos);

    (void)home.write ("last_failsafe.txt", "\033[2J" + std::string (1000, 'x'));
    const auto odd = reportWith (home).out;
    CHECK (odd.find ('\033') == std::string::npos);
    CHECK (odd.size() < 5000);

    std::filesystem::remove (note);
    REQUIRE (::mkfifo (note.c_str(), 0600) == 0);   // reading it would wait for ever
    CHECK (reportWith (home).out.find ("last failsafe: none\n") != std::string::npos);
}
