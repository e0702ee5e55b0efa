// SPDX-License-Identifier: MIT
#include "live_compiler.hpp"
#include "compiler_output.hpp"

#include <host/base/platform/preset_folder.hpp>
#include <host/base/platform/private_folder.hpp>
#include <host/base/platform/start_program.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/quote.hpp>

#include <cstdlib>
#include <sstream>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

/// Everything that <tactus/plugin/node_plugin.hpp> includes, without that header itself: its content depends on macros of a plugin.
constexpr const char* common_headers = R"(#include <tactus/node/node.hpp>
#include <tactus/plugin/described.hpp>
#include <tactus/plugin/device_link.hpp>
#include <tactus/plugin/lent_services.hpp>
)";

/// The development files next to this program, in an installation or in a build tree.
fs::path includeFolder() { return shipped ({ "../include/tactus/plugin/node_plugin.hpp" }).parent_path().parent_path().parent_path(); }

fs::path frameworkLibrary()
{
    std::vector<std::string> folders { "../framework", "../lib", "../lib64" };
    std::error_code unseen;
    for (const auto& entry : fs::directory_iterator (programFolder() / "../lib", unseen))   // such as lib/x86_64-linux-gnu
        if (entry.is_directory (unseen)) folders.push_back ("../lib/" + entry.path().filename().string());
    for (auto& folder : folders)
        folder += "/libtactus_framework.a";
    return shipped (folders);
}

fs::path eigenFolder()
{
    std::error_code unseen;
    for (const auto* folder : { "/usr/include/eigen3", "/usr/local/include/eigen3", "/opt/homebrew/include/eigen3" })
        if (fs::exists (folder, unseen)) return folder;
    return {};
}

std::string compilerOf (const LiveSource& source)
{
    if (! source.compiler.empty()) return source.compiler;
    const char* chosen = std::getenv ("CXX");
    return chosen != nullptr && *chosen != 0 ? chosen : source.isC() ? "cc"
                                                                     : "c++";
}

/// The files that a rule of a makefile lists after its target. A backslash precedes each space in a name, and joins lines.
std::vector<fs::path> wordsOfRule (const std::string& text)
{
    std::vector<fs::path> all;
    std::string word;
    const auto end = [&] {
        if (! word.empty()) all.emplace_back (word);
        word.clear();
    };
    for (auto i = std::min (text.find (": "), text.size()); i < text.size(); ++i)
    {
        if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == ' ')
            word += text[++i];
        else if (text[i] == ' ' || text[i] == '\n' || (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == '\n'))
            end();
        else if (text[i] != ':' || ! word.empty())
            word += text[i];
    }
    end();
    return all;
}
}   // namespace

LiveCompiler::~LiveCompiler()
{
    program.reset();
    if (folder.empty()) return;
    std::error_code ignored;
    fs::remove_all (folder, ignored);
}

Result<> LiveCompiler::needFolder (const LiveSource& s)
{
    if (folder.empty()) folder = privateFolder ("tactus-live-");
    if (folder.empty())
        return Message::error ("live/no_folder", s.file.string(), "no temporary folder can be made for compiled code, so edits of the C++ code have no effect",
                               "free some space in " + quote (temporaryFolder().string()) + ", or set TMPDIR to a folder that only this user may write");
    if (std::error_code unknown; fs::exists (commonHeader(), unknown)) return {};
    return writeTextFile (commonHeader(), common_headers);
}

Result<> LiveCompiler::prepareFor (const LiveSource& s)
{
    if (auto missing = needFolder (s); ! missing) return missing;
    const auto compiler = compilerOf (s);
    if (s.isC() || precompiled_by == compiler) return {};
    precompiled_by = compiler;
    precompiles = true;
    compiles_next = false;
    source = s;
    const auto header = commonHeader().string();
    auto command = commonFlags (s);
    command.insert (command.end(), { "-x", "c++-header", header, "-o", header + ".gch" });
    return run (command);
}

Result<> LiveCompiler::start (const LiveSource& s)
{
    if (auto trusted = s.trusted(); ! trusted) return trusted;
    if (auto missing = needFolder (s); ! missing) return missing;
    const bool is_prepared = work == Work::once || s.isC() || precompiled_by == compilerOf (s);
    if (! precompiles || ! is_prepared) program.reset();
    if (! is_prepared)
        if (auto refused = prepareFor (s); ! refused) return refused;
    source = s;
    if (! program) return compile();
    compiles_next = true;
    return {};
}

Result<> LiveCompiler::compile()
{
    precompiles = false;
    ++count;
    auto command = commandFor (source);
    return command ? run (*command) : Result<> { std::move (command).error() };
}

Result<> LiveCompiler::run (const std::vector<std::string>& command)
{
    const auto priority = work == Work::once ? BackgroundProgram::Priority::usual : BackgroundProgram::Priority::low;
    program = BackgroundProgram::start (command, folder / "says", BackgroundProgram::usual_cpu_seconds, priority);
    if (program) return {};
    return Message::error ("live/no_compiler", source.file.string(),
                           "the compiler " + quote (command.front()) + " cannot be started, so edits of the C++ code have no effect",
                           "install a C++20 compiler (Debian: apt install g++), or set CXX to one");
}

std::vector<std::string> LiveCompiler::commonFlags (const LiveSource& s) const
{
    std::vector<std::string> flags { compilerOf (s), "-O3", "-fPIC", "-fvisibility=hidden", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math",
                                     "-DEIGEN_DONT_VECTORIZE" };
#if defined(__x86_64__) || defined(__i386__)
    flags.insert (flags.end(), { "-mno-fma", "-mno-fma4", "-mno-avx512f" });   // as in CMakeLists.txt
#endif
    if (! s.isC()) flags.insert (flags.end(), { "-std=c++20", "-fvisibility-inlines-hidden" });
#if defined(__linux__)
    // Unique symbols would keep the plugin loaded forever. For the other flag, see tactus_add_plugin.
    if (flags.front().find ("clang") == std::string::npos) flags.insert (flags.end(), { "-fno-gnu-unique", "--param=inline-unit-growth=200" });
#endif
    if (const auto include = includeFolder(); ! include.empty()) flags.push_back ("-I" + include.string());
    if (const auto eigen = eigenFolder(); ! eigen.empty())
        flags.insert (flags.end(), { "-isystem", eigen.string() });
    return flags;
}

Result<std::vector<std::string>> LiveCompiler::commandFor (const LiveSource& s)
{
    if (includeFolder().empty() || frameworkLibrary().empty())
        return Message::error ("live/no_headers", s.file.string(), "the headers and libtactus_framework.a of Tactus are not next to this program",
                               "install the development files of Tactus (Debian: apt install libtactus-dev), or use the program of a build tree");
    auto command = commonFlags (s);
    for (const auto& include : s.includes)
        command.push_back ("-I" + include.string());
    if (! s.isC()) command.insert (command.end(), { "-include", commonHeader().string() });
    for (const auto& macro : s.definitions)
        command.push_back ("-D" + macro);
    const auto plugin = folder / (std::to_string (count) + ".tactus");
    command.insert (command.end(), { "-shared", "-MMD", "-MF", (folder / "read").string(), "-o", plugin.string() });
    if (s.sources.empty())
    {
        auto text = sourceFor (s.file);
        if (! text) return std::move (text).error();
        const auto file = folder / "plugin.cpp";
        if (auto written = writeTextFile (file, *text); ! written) return std::move (written).error();
        command.push_back (file.string());
    }
    for (const auto& file : s.sources)
        command.push_back (file.string());
    command.push_back (frameworkLibrary().string());
#if defined(__linux__)
    const auto exports = folder / "exports.map";   // the same as framework/plugin/plugin.map
    if (auto written = writeTextFile (exports, "{ global: tactus_plugin_entry; local: *; };\n"); ! written) return std::move (written).error();
    command.insert (command.end(), { "-Wl,--version-script=" + exports.string(), "-Wl,-z,now" });
#endif
    return command;
}

std::optional<LiveCompiler::Output> LiveCompiler::finished()
{
    if (! program) return std::nullopt;
    const auto status = program->status();
    if (! status) return std::nullopt;
    program.reset();
    if (precompiles)   // if this failed, the compilation of the source reports why, or only takes longer
    {
        precompiles = false;
        if (! compiles_next) return std::nullopt;
        const auto started = compile();
        return started ? std::nullopt : std::optional<Output> ({ {}, {}, { started.error() } });
    }
    Output output { folder / (std::to_string (count) + ".tactus"), filesRead(), {} };
    if (*status != 0) output.messages = errorsOf (readTextFile (folder / "says").value_or (""), source.file.string());
    return output;
}

std::vector<fs::path> LiveCompiler::filesRead() const
{
    auto all = wordsOfRule (readTextFile (folder / "read").value_or (""));
    std::erase_if (all, [this] (const fs::path& file) { return file.parent_path() == folder; });
    return all;
}

}   // namespace tactus::host
