// SPDX-License-Identifier: MIT
#include "device_file.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

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

std::string reportDescriptorOf (const std::string& path)
{
#if defined(__linux__)
    const auto name = std::filesystem::path (path).filename();
    std::ifstream file (std::filesystem::path ("/sys/class/hidraw") / name / "device/report_descriptor", std::ios::binary);
    return { std::istreambuf_iterator<char> (file), {} };
#else
    (void)path;
    return {};
#endif
}

bool isReportFile (const std::string& path) noexcept
{
#if defined(__linux__)
    return path.starts_with ("/dev/hidraw");
#else
    (void)path;
    return false;
#endif
}

}   // namespace tactus::host
