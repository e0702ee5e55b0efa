// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/compile.hpp>
#include <tactus/run/run.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The kind of code to write: the class alone, or with something around it.
enum class ExportTarget
{
    cpp,
    c_api,
    arduino,
    fmu,
    wasm
};

struct ExportOptions
{
    std::string file;         ///< name of the graph file, for comments; its stem names the class
    std::string program;      ///< "tactus 0.2.0"
    CompileOptions compile;   ///< feeds become inputs, and records outputs
    ExportTarget target = ExportTarget::cpp;
    bool is_single = false;   ///< with float instead of double, and positions with more digits (kit/fine.hpp)
    Run::OpenDevice open;     ///< the devices of the self-test; empty: those that the graph describes, simulated
};

/// A folder of C++ files that is not written yet.
struct ExportedFolder
{
    std::vector<std::pair<std::string, std::string>> files;   ///< path and text; empty if there are errors
    std::string stem, class_name;
    Messages messages;
};

/// Turns a graph into C++ code that computes the same bits, with a self-test. Its own ids: export/plugin (a node whose code is not part of
/// the program), export/role (an Arduino library needs a device), export/float (what has no single-precision export).
/// [main thread]
ExportedFolder exportGraph (const graph::Graph&, const ExportOptions&);

/// Writes the files as a new folder, or in place of an earlier export: its other files stay. The folder changes in one step: see AtomicFolder.
/// Errors: output/exists, output/unwritable. [main thread]
Result<> writeFolder (const ExportedFolder&, const std::filesystem::path&);

/// Checks that the folder can be written: it is new or empty, or holds an earlier export of this user. Error: output/exists.
Result<> canWriteFolder (const std::filesystem::path&);

}   // namespace tactus::host
