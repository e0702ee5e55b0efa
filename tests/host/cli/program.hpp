// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::test
{

/// A folder of its own for a test, gone with it.
class Scratch
{
public:
    Scratch();
    ~Scratch();
    Scratch (const Scratch&) = delete;
    Scratch& operator= (const Scratch&) = delete;

    std::string path (const std::string& name) const { return (folder / name).string(); }
    std::string write (const std::string& name, const std::string& text) const;

private:
    std::filesystem::path folder;
};

/// What a run of a program left behind.
struct Ran
{
    int status;
    std::string out, err;
};

/// Runs the program `tactus`, or another one, with these arguments.
Ran runTactus (const std::vector<std::string>& arguments);
Ran runProgram (const std::string& program, const std::vector<std::string>& arguments);

std::string textOf (const std::string& path);

/// ../shared/data, or "" with a warning that the test is skipped where it is absent.
std::string sharedData (const std::string& folder);

}   // namespace tactus::test
