// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion_compiler.hpp"

#include <host/generate/sources.hpp>
#include <host/platform/private_folder.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <utility>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

constexpr std::size_t most_kept = 64;   // objects in the cache, of about 100 kB each

std::string environment (const char* name)
{
    const char* value = std::getenv (name);
    return value != nullptr ? value : "";
}

/// Two 64-bit hashes of some texts: FNV-1a, with two starting values.
class Digest
{
public:
    void add (std::string_view text)
    {
        for (const char c : text)
            for (auto& n : numbers)
                n = (n ^ static_cast<unsigned char> (c)) * 0x100000001b3u;
        for (auto& n : numbers)
            n = (n ^ 0x1ffu) * 0x100000001b3u;   // a value that is no byte, so that the end of each text changes the result
    }

    std::string text() const
    {
        std::array<char, 40> all {};
        std::snprintf (all.data(), all.size(), "%016llx%016llx", static_cast<unsigned long long> (numbers[0]), static_cast<unsigned long long> (numbers[1]));
        return all.data();
    }

private:
    std::array<std::uint64_t, 2> numbers { 0xcbf29ce484222325u, 0x9ae16a3b2f90404fu };
};

/// The options among the compiler flags of this program that can change how a struct lies in memory.
std::vector<std::string> machineFlags()
{
    std::vector<std::string> all;
    std::istringstream words (TACTUS_COMPILER_FLAGS);
    for (std::string word; words >> word;)
        if (word.starts_with ("-m")) all.push_back (word);
    return all;
}

/// The compiler's file, with its size and the time of its last change, so that a new version of the compiler compiles again.
std::string identityOf (const std::string& compiler)
{
    std::error_code unseen;
    std::istringstream folders (compiler.find ('/') != std::string::npos ? "." : environment ("PATH"));
    for (std::string folder; std::getline (folders, folder, ':');)
    {
        const auto file = fs::canonical (fs::path (folder) / compiler, unseen);
        if (unseen) continue;
        const auto size = fs::file_size (file, unseen);
        const auto changed = fs::last_write_time (file, unseen).time_since_epoch().count();
        return file.string() + " " + std::to_string (size) + " " + std::to_string (changed);
    }
    return compiler;
}

/// True if the folder exists, and only this user can write to it.
bool isPrivate (const fs::path& folder)
{
    std::error_code failed;
    const auto status = fs::status (folder, failed);
    return ! failed && fs::is_directory (status) && (status.permissions() & (fs::perms::group_write | fs::perms::others_write)) == fs::perms::none;
}

bool makePrivate (const fs::path& folder)
{
    std::error_code failed;
    if (fs::create_directories (folder, failed)) fs::permissions (folder, fs::perms::owner_all, failed);
    return isPrivate (folder);
}

void removeOldest (const fs::path& folder)
{
    std::error_code ignored;
    std::vector<std::pair<fs::file_time_type, fs::path>> all;
    for (const auto& entry : fs::directory_iterator (folder, ignored))
        if (entry.path().extension() == ".so") all.emplace_back (entry.last_write_time (ignored), entry.path());
    if (all.size() <= most_kept) return;
    std::ranges::sort (all);
    for (std::size_t i = 0; i + most_kept < all.size(); ++i)
        fs::remove (all[i].second, ignored);
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
}   // namespace

FusionCompiler::FusionCompiler (Options o) : options ([&o] {
                                                 if (o.compiler.empty()) o.compiler = environment ("CXX");
                                                 if (o.compiler.empty()) o.compiler = "c++";
                                                 return std::move (o);
                                             }())
{
}

FusionCompiler::~FusionCompiler()
{
    program.reset();
    if (folder.empty()) return;
    std::error_code ignored;
    fs::remove_all (folder, ignored);
}

fs::path FusionCompiler::usualCache()
{
    if (const auto own = environment ("TACTUS_HOME"); ! own.empty()) return fs::path (own) / "fused";
    if (const auto cache = environment ("XDG_CACHE_HOME"); ! cache.empty()) return fs::path (cache) / "tactus" / "fused";
    if (const auto home = environment ("HOME"); ! home.empty()) return fs::path (home) / ".cache" / "tactus" / "fused";
    return {};
}

std::vector<std::string> FusionCompiler::flagsFor (const std::string& compiler) const
{
    std::vector<std::string> flags { "-std=c++20", options.optimisation, "-DNDEBUG", "-w", "-shared", "-fPIC" };
    flags.insert (flags.end(), { "-fvisibility=hidden", "-fvisibility-inlines-hidden", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math" });
    auto machine = machineFlags();
    std::ranges::move (machine, std::back_inserter (flags));
#if defined(__x86_64__) || defined(__i386__)
    flags.insert (flags.end(), { "-mno-fma", "-mno-fma4", "-mno-avx512f" });   // as in CMakeLists.txt
#endif
#if defined(__linux__)
    // Only the tick is called from outside. When GCC knows that, it inlines what the tick calls only once, however large that is.
    if (compiler.find ("clang") == std::string::npos)
        flags.insert (flags.end(), { "-fwhole-program", "-fno-gnu-unique", "--param=inline-unit-growth=400", "--param=large-function-growth=2000" });
    flags.push_back ("-Wl,-z,now");
#endif
    std::error_code unseen;
    for (const auto* eigen : { "/usr/include/eigen3", "/usr/local/include/eigen3", "/opt/homebrew/include/eigen3" })
        if (fs::exists (eigen, unseen))
        {
            flags.insert (flags.end(), { "-isystem", eigen });
            break;
        }
    flags.insert (flags.end(), options.flags.begin(), options.flags.end());
    return flags;
}

std::string FusionCompiler::keyOf (const FusedCode& code) const
{
    Digest digest;
    digest.add (code.text);
    for (const auto& path : withIncludes (code.headers))
        digest.add (findSource (path)->text);
    digest.add (identityOf (options.compiler));
    for (const auto& flag : flagsFor (options.compiler))
        digest.add (flag);
    return digest.text();
}

Result<> FusionCompiler::write (const FusedCode& code)
{
    if (folder.empty()) folder = privateFolder ("tactus-fuse-");
    if (folder.empty())
        return Message::error ("fuse/no_folder", {}, "no folder can be made for what is compiled, so the graph is not fused",
                               "free some space in " + quote (temporaryFolder().string()) + ", or set TMPDIR to a folder that this user may write");
    for (const auto& path : withIncludes (code.headers))
    {
        if (! path.ends_with (".hpp") || ! written.insert (path).second) continue;
        std::error_code failed;
        fs::create_directories ((folder / path).parent_path(), failed);
        if (auto done = writeTextFile (folder / path, std::string (findSource (path)->text)); ! done) return done;
    }
    return writeTextFile (folder / "fused.cpp", code.text);
}

Result<> FusionCompiler::start (const FusedCode& code)
{
    program.reset();
    ready.clear();
    key = keyOf (code);
    std::error_code unseen;
    if (const auto kept = options.cache / (key + ".so"); ! options.cache.empty() && isPrivate (options.cache) && fs::exists (kept, unseen))
    {
        fs::last_write_time (kept, fs::file_time_type::clock::now(), unseen);   // the oldest are removed first
        ready = kept;
        return {};
    }
    if (auto done = write (code); ! done) return done;
    std::vector<std::string> command { options.compiler };
    auto flags = flagsFor (options.compiler);
    std::ranges::move (flags, std::back_inserter (command));
    command.insert (command.end(), { "-I" + folder.string(), (folder / "fused.cpp").string(), "-o", (folder / (std::to_string (++count) + ".so")).string() });
    program = BackgroundProgram::start (command, folder / "says", options.cpu_seconds);
    if (program) return {};
    return Message::error ("fuse/no_compiler", {}, "the compiler " + quote (options.compiler) + " cannot be started, so the graph is not fused",
                           "install a C++20 compiler and Eigen (Debian: apt install g++ libeigen3-dev), or set CXX to one");
}

/// Puts an object in the cache. If that fails, the object stays where it is.
fs::path FusionCompiler::keep (const fs::path& object)
{
    if (options.cache.empty() || ! makePrivate (options.cache)) return object;
    std::error_code failed;
    const auto kept = options.cache / (key + ".so"), part = options.cache / (key + "." + folder.filename().string());
    fs::copy_file (object, part, fs::copy_options::overwrite_existing, failed);
    if (! failed) fs::rename (part, kept, failed);   // atomic, so that no other program sees half a file
    std::error_code ignored;
    if (failed) fs::remove (part, ignored);
    removeOldest (options.cache);
    return failed ? object : kept;
}

std::optional<Result<fs::path>> FusionCompiler::finished()
{
    if (! ready.empty()) return std::exchange (ready, {});
    if (! program) return std::nullopt;
    const auto status = program->status();
    if (! status) return std::nullopt;
    program.reset();
    const auto object = folder / (std::to_string (count) + ".so");
    if (*status == 0) return keep (object);
    const auto said = beginOf (readTextFile (folder / "says").value_or (""));
    const auto why = *status < 0 ? std::string ("the compiler was ended") : said.empty() ? "the compiler failed"
                                                                                         : "the compiler says: " + said;
    return Result<fs::path> { Message::error ("fuse/compile", {}, "the graph is not fused: " + why,
                                              "the run continues as it is; check that the compiler knows C++20 and finds Eigen 3.4") };
}

}   // namespace tactus::host
