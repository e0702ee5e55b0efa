// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/generate/export_graph.hpp>
#include <support/temporary_folder.hpp>

#include <set>
#include <string>
#include <vector>

namespace tactus::test
{

/// A hand that moves at random with the seed, sometimes to positions that are not finite.
Run::OpenDevice randomHands (unsigned seed);

/// A random graph (support/random_graph.hpp) as C++ code, with every component of every output recorded and some inputs fed.
host::ExportedFolder exportedRandomGraph (unsigned seed, int size);

/// A preset as C++ code; the devices are those that it describes.
host::ExportedFolder exportedPreset (const std::string& name, host::ExportTarget = host::ExportTarget::cpp);

/// The text of a file of an export.
std::string& textOf (host::ExportedFolder&, const std::string& path);

/// The names of all presets.
std::vector<std::string> presetNames();

/// Many exported graphs in one program, which runs all their self-tests.
class ExportedProgram
{
public:
    void add (const host::ExportedFolder&);
    int graphCount() const noexcept { return static_cast<int> (stems.size()); }

    /// Compiles and runs the program. Returns what the compiler and the program said, beginning with "passed" or "failed".
    std::string run (const std::string& compiler, const std::string& flags) const;

    /// The same on a Cortex-M7 in QEMU: compiled with arm-none-eabi-g++. For each graph, also says how many bytes it takes and how many
    /// instructions a tick takes on average.
    std::string runOnM7 (const std::string& flags) const;

private:
    TemporaryFolder folder;
    std::set<std::string> sources;
    std::vector<std::string> stems, classes;

    void writeMain (const std::string& head, const std::string& per_graph) const;
    std::string compileAndRun (const std::string& compile, const std::string& run) const;
};

}   // namespace tactus::test
