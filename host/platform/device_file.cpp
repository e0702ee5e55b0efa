// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_file.hpp"

#if ! defined(_WIN32)
#include <unistd.h>

#include <cerrno>
#endif

namespace tactus::host
{

bool isForbidden (const std::string& path) noexcept
{
#if defined(_WIN32)
    (void)path;
    return false;
#else
    return ::access (path.c_str(), R_OK | W_OK) != 0 && (errno == EACCES || errno == EPERM);
#endif
}

std::filesystem::path programFolder()
{
#if defined(__linux__)
    std::error_code failed;
    const auto program = std::filesystem::read_symlink ("/proc/self/exe", failed);
    return failed ? std::filesystem::path {} : program.parent_path();
#else
    return {};
#endif
}

}   // namespace tactus::host
