// SPDX-License-Identifier: MIT
#pragma once

#include <host/code/generate/export_graph.hpp>
#include <support/temporary_folder.hpp>

#include <set>
#include <string>
#include <vector>

namespace tactus::test
{

/// A hand that moves at random with the seed, sometimes to positions that are not finite.
Run::OpenDevice randomHands (unsigned seed);

/// A random graph (support/random_graph.hpp) as C++ code, with every component of every output recorded and some inputs fed.
host::ExportedFolder exportedRandomGraph (unsigned seed, int size, bool is_single = false);

/// A preset as C++ code; the devices are those that it describes.
host::ExportedFolder exportedPreset (const std::string& name, bool is_single = false);

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

    /// Compiles the program and runs it, with all features of the processor, and without AVX and FMA. Returns what the compiler and the
    /// program said, beginning with "passed" or "failed". For each graph, also says how many bytes an object, its inputs and its outputs take.
    std::string run (const std::string& compiler, const std::string& flags) const;

    /// A Cortex-M7, with a unit for doubles, or a Cortex-M4, with one for floats.
    enum class Board
    {
        m7,
        m4
    };

    /// The same on a board in QEMU, ten graphs at a time: compiled with arm-none-eabi-g++. For each graph, also says how many bytes it takes and how many
    /// instructions a tick takes on average.
    std::string runOn (Board, const std::string& flags) const;

    /// The same in node, compiled for WebAssembly with clang++-22, and natively. For each graph, also says how long a tick takes, as
    /// "NAME natively: 123 ns", the two programs in turns.
    std::string runInNode (const std::string& flags) const;

    /// The lines of the disassembly of the last program that have this pattern (of grep -E), at most ten.
    std::string instructions (const std::string& pattern) const;

    /// The functions with these names (a pattern of grep -E) that the graphs call on a board, apart from the self-tests.
    std::string callsOn (Board, const std::string& pattern) const;

private:
    TemporaryFolder folder;
    std::set<std::string> sources;
    std::vector<std::string> stems, classes;

    void writeMain (const std::string& head, const std::string& per_graph, std::size_t first = 0, std::size_t count = std::string::npos) const;
    bool succeeds (const std::string& command) const;
    bool compile (const std::string& compiler, std::string& objects) const;
    std::string compileAndRun (const std::string& compiler, const std::string& link, const std::string& run) const;
};

}   // namespace tactus::test
