// SPDX-License-Identifier: GPL-3.0-or-later
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
}   // namespace

fs::path besideThisProgram (const std::string& name)
{
#if defined(_WIN32)
    return thisProgram().parent_path() / (name + ".exe");
#else
    return thisProgram().parent_path() / name;
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
