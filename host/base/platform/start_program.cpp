// SPDX-License-Identifier: MIT
#include "start_program.hpp"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#if defined(_WIN32)
#include <process.h>
#include <windows.h>
#elif defined(__APPLE__)
#include <mach-o/dyld.h>
#include <unistd.h>
#else
#include <dlfcn.h>
#include <unistd.h>
#endif

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

fs::path thisProgram()
{
#if defined(_WIN32)
    wchar_t path[4096];
    return { path, path + GetModuleFileNameW (nullptr, path, static_cast<DWORD> (std::size (path))) };
#elif defined(__APPLE__)
    char path[4096];
    std::uint32_t size = sizeof path;
    return _NSGetExecutablePath (path, &size) == 0 ? fs::path (path) : fs::path();
#else
    std::error_code failed;
    return fs::read_symlink ("/proc/self/exe", failed);
#endif
}

/// The shared library that this code is in; empty if it is in the program itself.
fs::path thisLibrary()
{
#if defined(__linux__)
    Dl_info code {};
    std::error_code failed;
    if (::dladdr (reinterpret_cast<const void*> (&thisLibrary), &code) == 0 || code.dli_fname == nullptr) return {};
    auto file = fs::canonical (code.dli_fname, failed);
    return failed || file == fs::canonical (thisProgram(), failed) || file.filename().string().find (".so") == std::string::npos ? fs::path {} : file;
#else
    return {};
#endif
}
}   // namespace

fs::path programFolder()
{
    const auto library = thisLibrary();
    if (library.empty()) return thisProgram().parent_path();
    const auto folder = library.parent_path();
    for (const auto& lib : { folder, folder.parent_path() })   // lib, or lib/x86_64-linux-gnu
        if (lib.filename() == "lib" || lib.filename() == "lib64") return lib.parent_path() / "bin";
    return folder;
}

fs::path besideThisProgram (const std::string& name)
{
#if defined(_WIN32)
    return programFolder() / (name + ".exe");
#else
    return programFolder() / name;
#endif
}

std::string becomeProgram (const fs::path& program, const std::vector<std::string>& arguments)
{
    auto path = program.string();
    auto copies = arguments;
    std::vector<char*> all { path.data() };
    for (auto& a : copies)
        all.push_back (a.data());
    all.push_back (nullptr);
#if defined(_WIN32)
    if (const auto status = _spawnv (_P_WAIT, path.c_str(), all.data()); status != -1) std::exit (static_cast<int> (status));
#else
    execv (path.c_str(), all.data());
#endif
    return std::generic_category().message (errno);
}

}   // namespace tactus::host
