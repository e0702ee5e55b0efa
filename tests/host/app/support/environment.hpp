// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_core/juce_core.h>

#include <cstdlib>
#include <filesystem>

namespace tactus::host::test
{

/// Sets an environment variable for the lifetime of this object.
class Environment
{
public:
    Environment (const char* n, const std::filesystem::path& value) : name (n), before (juce::SystemStats::getEnvironmentVariable (n, {}))
    {
        setenv (name, value.c_str(), 1);
    }

    ~Environment() { before.isEmpty() ? unsetenv (name) : setenv (name, before.toRawUTF8(), 1); }

    Environment (const Environment&) = delete;
    Environment& operator= (const Environment&) = delete;

private:
    const char* name;
    const juce::String before;
};

}   // namespace tactus::host::test
