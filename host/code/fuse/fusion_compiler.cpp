// SPDX-License-Identifier: MIT
#include "fusion_compiler.hpp"
#include "bitcode.hpp"

#include <host/base/platform/private_folder.hpp>
#include <host/base/platform/start_program.hpp>
#include <host/code/generate/sources/sources.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <utility>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

/// The options among the compiler flags of this program that can change how a struct is laid out in memory.
std::vector<std::string> machineFlags()
{
    std::vector<std::string> all;
    std::istringstream words (TACTUS_COMPILER_FLAGS);
    for (std::string word; words >> word;)
        if (word.starts_with ("-m")) all.push_back (word);
    return all;
}

/// A program's file, with its size and the time of its last change, so that a new version of a compiler compiles again.
std::string identityOf (const std::string& program)
{
    std::error_code unseen;
    std::istringstream folders (program.find ('/') != std::string::npos ? "." : environment ("PATH"));
    for (std::string folder; std::getline (folders, folder, ':');)
    {
        const auto file = fs::canonical (fs::path (folder) / program, unseen);
        if (unseen) continue;
        const auto size = fs::file_size (file, unseen);
        const auto changed = fs::last_write_time (file, unseen).time_since_epoch().count();
        return file.string() + " " + std::to_string (size) + " " + std::to_string (changed);
    }
    return program;
}

/// The first lines of what a compiler says.
std::string beginOf (const std::string& said)
{
    std::istringstream lines (said);
    std::string all, line;
    for (int i = 0; i < 4 && std::getline (lines, line); ++i)
        all += (i > 0 ? "; " : "") + line;
    return all;
}

/// Exit statuses of tactus-fuse-llvm: something is not installed.
constexpr int no_library = 3, no_linker = 4;

Message noLlvm (const std::string& why)
{
    return Message::error ("fuse/no_llvm", {}, why + ", so LLVM cannot fuse the graph", "install LLVM and a linker (Debian: apt install libllvm14 binutils)");
}

/// The file name of the bitcode of a header.
std::string bitcodeFile (const std::string& header) { return bitcodeName ("code", header) + ".bc"; }
}   // namespace

FusionCompiler::FusionCompiler (Options o) : options ([&o] {
                                                 if (o.compiler.empty()) o.compiler = environment ("CXX");
                                                 if (o.compiler.empty()) o.compiler = "c++";
                                                 if (o.llvm.empty()) o.llvm = environment ("TACTUS_FUSE_LLVM");
                                                 if (o.llvm.empty()) o.llvm = besideThisProgram ("tactus-fuse-llvm").string();
                                                 return std::move (o);
                                             }()),
                                             cache (options.cache)
{
}

FusionCompiler::~FusionCompiler()
{
    program.reset();
    if (folder.empty()) return;
    std::error_code ignored;
    fs::remove_all (folder, ignored);
}

std::vector<std::string> FusionCompiler::flags() const
{
    std::vector<std::string> all { "-std=c++20", options.optimisation, "-DNDEBUG", "-w", "-shared", "-fPIC" };
    all.insert (all.end(), { "-fvisibility=hidden", "-fvisibility-inlines-hidden", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math", "-DEIGEN_DONT_VECTORIZE" });
    auto machine = machineFlags();
    std::ranges::move (machine, std::back_inserter (all));
#if defined(__x86_64__) || defined(__i386__)
    all.insert (all.end(), { "-mno-fma", "-mno-fma4", "-mno-avx512f" });   // as in CMakeLists.txt
#endif
#if defined(__linux__)
    // Only the tick is called from outside. When GCC knows that, it inlines what the tick calls only once, however large that is.
    if (options.compiler.find ("clang") == std::string::npos)
        all.insert (all.end(), { "-fwhole-program", "-fno-gnu-unique", "--param=inline-unit-growth=400", "--param=large-function-growth=2000" });
    all.push_back ("-Wl,-z,now");
#endif
    std::error_code unseen;
    for (const auto* eigen : { "/usr/include/eigen3", "/usr/local/include/eigen3", "/opt/homebrew/include/eigen3" })
        if (fs::exists (eigen, unseen))
        {
            all.insert (all.end(), { "-isystem", eigen });
            break;
        }
    all.insert (all.end(), options.flags.begin(), options.flags.end());
    return all;
}

std::string FusionCompiler::keyOf (const FusedCode& code) const
{
    Digest digest;
    digest.add (code.text);
    if (code.language == FusedCode::Language::llvm)
    {
        for (const auto& header : code.headers)
            digest.add (findBitcode (header));
        digest.add (identityOf (options.llvm));
        return digest.text();
    }
    for (const auto& path : withIncludes (code.headers))
        digest.add (findSource (path)->text);
    digest.add (identityOf (options.compiler));
    for (const auto& flag : flags())
        digest.add (flag);
    return digest.text();
}

/// Writes the headers that the code includes, or the bitcode in their place, unless they are in the folder already.
Result<> FusionCompiler::writeHeaders (const FusedCode& code)
{
    if (code.language == FusedCode::Language::llvm)
    {
        for (const auto& header : code.headers)
            if (const auto file = bitcodeFile (header); written.insert (file).second)
                if (auto done = writeTextFile (folder / file, std::string (findBitcode (header))); ! done) return done;
        return {};
    }
    for (const auto& path : withIncludes (code.headers))
    {
        if (! path.ends_with (".hpp") || ! written.insert (path).second) continue;
        std::error_code failed;
        fs::create_directories ((folder / path).parent_path(), failed);
        if (auto done = writeTextFile (folder / path, std::string (findSource (path)->text)); ! done) return done;
    }
    return {};
}

Result<> FusionCompiler::write (const FusedCode& code)
{
    if (folder.empty()) folder = privateFolder ("tactus-fuse-");
    if (folder.empty())
        return Message::error ("fuse/no_folder", {}, "no temporary folder can be made for compiled code, so the graph is not fused",
                               "free some space in " + quote (temporaryFolder().string()) + ", or set TMPDIR to a folder that only this user may write");
    if (auto done = writeHeaders (code); ! done) return done;
    return writeTextFile (sourceOf (code), code.text);
}

fs::path FusionCompiler::sourceOf (const FusedCode& code) const { return folder / (code.language == FusedCode::Language::llvm ? "fused.ll" : "fused.cpp"); }

std::vector<std::string> FusionCompiler::commandFor (const FusedCode& code) const
{
    const auto source = sourceOf (code).string(), object = (folder / (std::to_string (count) + ".so")).string();
    if (code.language == FusedCode::Language::llvm)
    {
        std::vector<std::string> command { options.llvm, FusedCode::function, object, source };
        for (const auto& header : code.headers)
            command.push_back ((folder / bitcodeFile (header)).string());
        return command;
    }
    std::vector<std::string> command { options.compiler };
    auto all = flags();
    std::ranges::move (all, std::back_inserter (command));
    command.insert (command.end(), { "-I" + folder.string(), source, "-o", object });
    return command;
}

Result<> FusionCompiler::start (const FusedCode& code)
{
    program.reset();
    ready.clear();
    language = code.language;
    key = keyOf (code);
    if (auto kept = cache.find (key))
    {
        ready = std::move (*kept);
        return {};
    }
    if (auto done = write (code); ! done) return done;
    ++count;
    program = BackgroundProgram::start (commandFor (code), folder / "says", options.cpu_seconds);
    if (program) return {};
    if (language == FusedCode::Language::llvm) return noLlvm (quote (options.llvm) + " cannot be started");
    return Message::error ("fuse/no_compiler", {}, "the compiler " + quote (options.compiler) + " cannot be started, so the graph is not fused",
                           "install LLVM (Debian: apt install libllvm14 binutils), or a C++20 compiler and Eigen (Debian: apt install g++ libeigen3-dev); "
                           "CXX names another compiler");
}

std::optional<Result<fs::path>> FusionCompiler::finished()
{
    if (! ready.empty()) return std::exchange (ready, {});
    if (! program) return std::nullopt;
    const auto status = program->status();
    if (! status) return std::nullopt;
    program.reset();
    const auto object = folder / (std::to_string (count) + ".so");
    if (*status == 0) return cache.keep (object, key);
    const auto said = beginOf (readTextFile (folder / "says").value_or (""));
    if (language == FusedCode::Language::llvm && (*status == no_library || *status == no_linker)) return Result<fs::path> { noLlvm (said) };
    const auto why = *status < 0 ? std::string ("the compiler was ended") : said.empty() ? "the compiler failed"
                                                                                         : "the compiler says: " + said;
    return Result<fs::path> { Message::error ("fuse/compile", {}, "the graph is not fused: " + why,
                                              "the run continues as it is; check that the compiler knows C++20 and finds Eigen 3.4") };
}

}   // namespace tactus::host
