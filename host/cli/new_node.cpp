// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "report.hpp"

#include <host/base/platform/atomic_folder.hpp>
#include <host/base/platform/start_program.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

struct NewNodeOptions
{
    std::string family, name, folder;
    bool only_write = false;
};

constexpr const char* header_template = R"(#pragma once

#include <tactus/node/node.hpp>

namespace @FAMILY@
{

using namespace tactus;

/// The feel of the node, in one sentence.
///
///     f = -k z                                   z: depth below the plane z = 0
///
/// Source: where the equations come from. Say what the node is not good for.
struct @TYPE@
{
    struct Inputs
    {
        Vec3 position = Vec3::Zero();
    };

    struct Params
    {
        double stiffness = 500.0;
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "@FAMILY@.@NAME@",
        .name = "@TITLE@",
        .summary = "Pushes the tool out of the half space below z = 0.",
        .source = "own",
    };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position"),
        param (&Params::stiffness, "stiffness", unit::stiffness, "force per depth", { .hard = { 0, inf }, .usual = { 0, 2000 } }),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! isFinite (in.position) || in.position.z() >= 0.0) return {};
        return { .force = finiteOrZero (Vec3 (0.0, 0.0, -params.stiffness * in.position.z())) };
    }
};

}   // namespace @FAMILY@

TACTUS_NODE (@FAMILY@::@TYPE@);
)";

constexpr const char* source_template = R"(#include <tactus/plugin/node_plugin.hpp>

#include "@NAME@.hpp"

TACTUS_PLUGIN (@FAMILY@::@TYPE@)
)";

constexpr const char* test_template = R"(#include "@NAME@.hpp"

#include <cmath>
#include <cstdio>

// Each check states a law of the model.
int main()
{
    @FAMILY@::@TYPE@ node;
    const auto at = [&] (double z) { return node.tick ({ .position = { 0.0, 0.0, z } }).force.z(); };
    const bool is_right = at (1e-3) == 0.0 && std::abs (at (-1e-3) - 0.5) < 1e-12 && at (NAN) == 0.0;
    std::puts (is_right ? "@FAMILY@.@NAME@: ok" : "@FAMILY@.@NAME@: the force is not k z");
    return is_right ? 0 : 1;
}
)";

constexpr const char* cmake_template = R"(cmake_minimum_required (VERSION 3.22)
project (@NAME@ VERSION 0.1.0 LANGUAGES CXX)
find_package (Tactus 0.2 REQUIRED)

tactus_add_plugin (@NAME@ @NAME@.cpp)   # @NAME@.tactus

enable_testing ()
add_executable (@NAME@_test @NAME@_test.cpp)
target_link_libraries (@NAME@_test PRIVATE tactus::plugin_kit)
add_test (NAME @NAME@ COMMAND @NAME@_test)

# `tactus export` finds the header next to the plugin.
install (TARGETS @NAME@ LIBRARY DESTINATION lib/tactus/plugins)
install (FILES @NAME@.hpp DESTINATION lib/tactus/plugins)
)";

constexpr const char* readme_template = R"(# @FAMILY@.@NAME@

A node for Tactus, as a plugin.

    cmake -B build && cmake --build build && ctest --test-dir build
    tactus nodes @FAMILY@.@NAME@ --plugins build
    tactus play my_graph.json --plugins build

The model is in `@NAME@.hpp`; the same header also works compiled into a program (`tactus_add_nodes`). To have the node in every graph, copy
`build/@NAME@.tactus` into a folder in which Tactus looks for plugins, such as `~/.config/Tactus/plugins` (docs/plugins.md lists them). Copy
`@NAME@.hpp` next to it, so that `tactus export` finds the code of the node.
)";

bool isName (const std::string& s)
{
    const auto isLetter = [] (char c) { return c >= 'a' && c <= 'z'; };
    return ! s.empty() && isLetter (s.front()) && std::ranges::all_of (s, [&] (char c) { return isLetter (c) || (c >= '0' && c <= '9') || c == '_'; });
}

/// "RoughWood" for "rough_wood".
std::string typeName (const std::string& name)
{
    std::string type;
    bool starts = true;
    for (const char c : name)
    {
        if (c != '_') type += starts ? static_cast<char> (std::toupper (static_cast<unsigned char> (c))) : c;
        starts = c == '_';
    }
    return type;
}

std::string title (std::string name)
{
    std::ranges::replace (name, '_', ' ');
    name.front() = static_cast<char> (std::toupper (static_cast<unsigned char> (name.front())));
    return name;
}

std::string filled (std::string text, const NewNodeOptions& options)
{
    const std::pair<std::string, std::string> words[] {
        { "@FAMILY@", options.family }, { "@NAME@", options.name }, { "@TYPE@", typeName (options.name) }, { "@TITLE@", title (options.name) }
    };
    for (const auto& [mark, word] : words)
        for (auto at = text.find (mark); at != std::string::npos; at = text.find (mark, at + word.size()))
            text.replace (at, mark.size(), word);
    return text;
}

void check (const NewNodeOptions& options, const fs::path& folder)
{
    for (const auto& word : { options.family, options.name })
        if (! isName (word)) fail ("node/name", quote (word) + " is not a name for a node", "use lower-case letters, digits and _, beginning with a letter");
    if (const auto* there = catalogue().find (options.family + "." + options.name))
        fail ("node/exists", "there is a node " + quote (there->info.id) + " already", "choose another name; `tactus nodes` lists them all");
    if (auto can = AtomicFolder::check (folder); ! can) fail (std::move (can).error());
}

/// The path in quotation marks, which the shell reads as one word.
std::string shellWord (const fs::path& path)
{
    std::string word = "'";
    for (const char c : path.string())
        word += c == '\'' ? std::string ("'\\''") : std::string (1, c);
    return word + "'";
}

/// The folders in which CMake looks for Tactus: those that the user names, then the installation or the build tree of this program.
std::string prefixes()
{
    const char* told = std::getenv ("CMAKE_PREFIX_PATH");
    std::string all = told != nullptr ? told : "";
    std::ranges::replace (all, ':', ';');
    const auto own = (programFolder() / "..").lexically_normal();
    return all + (all.empty() ? "" : ";") + own.string() + ";" + (own / "plugin_kit").string();
}

void build (const fs::path& folder)
{
    const auto there = shellWord (folder), into = shellWord (folder / "build");
    const auto command = "cmake -S " + there + " -B " + into + " -DCMAKE_BUILD_TYPE=Release " + shellWord ("-DCMAKE_PREFIX_PATH=" + prefixes()) + " > /dev/null"
                         + " && cmake --build " + into + " && cd " + into + " && ctest";
    std::cout << std::flush;
    if (std::system (command.c_str()) != 0)
        fail ("plugin/not_built", "the new node has been written, but does not build: see above",
              "install CMake, a C++20 compiler and the development files of Tactus (docs/library.md), or set CMAKE_PREFIX_PATH to where they are");
}

void run (const NewNodeOptions& options)
{
    const fs::path folder = options.folder.empty() ? fs::path (options.name) : fs::path (options.folder);
    check (options, folder);
    const std::pair<std::string, const char*> files[] { { options.name + ".hpp", header_template },
                                                        { options.name + ".cpp", source_template },
                                                        { options.name + "_test.cpp", test_template },
                                                        { "CMakeLists.txt", cmake_template },
                                                        { "README.md", readme_template } };
    auto made = AtomicFolder::create (folder);
    if (! made) fail (std::move (made).error());
    for (const auto& [file, text] : files)
        if (auto written = made->write (file, filled (text, options)); ! written) fail (written.error());
    if (auto placed = made->commit(); ! placed) fail (placed.error());
    for (const auto& [file, text] : files)
        std::cout << printable ((folder / file).string()) << '\n';
    if (! options.only_write) build (folder);
    std::cout << "try it: tactus nodes " << options.family << '.' << options.name << " --plugins " << printable ((folder / "build").string()) << '\n';
}
}   // namespace

void addNewNode (const Command& app)
{
    const auto options = std::make_shared<NewNodeOptions>();
    const auto command = app.add ("new-node", "Write a node of your own as a plugin, with a test, and build it");
    command.addOption ("family", options->family, "The first half of its id, such as your lab or project").required();
    command.addOption ("name", options->name, "The second half of its id, such as rough_wood").required();
    command.addOption ("folder", options->folder, "The folder to write, which must be new or empty; default: NAME");
    command.addFlag ("--only-write", options->only_write, "Do not build it");
    command.footer ("Examples:\n"
                    "  tactus new-node mylab rough_wood\n"
                    "  tactus nodes mylab.rough_wood --plugins rough_wood/build");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
