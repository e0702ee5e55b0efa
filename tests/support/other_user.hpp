// SPDX-License-Identifier: MIT
#pragma once

#include <catch2/catch.hpp>

#include <filesystem>

#if ! defined(_WIN32)
#include <unistd.h>
#endif

namespace tactus::test
{

/// Gives a file, folder or link to another user. Only root can: otherwise returns false, with a warning that the test is skipped.
inline bool giveAway (const std::filesystem::path& path)
{
#if ! defined(_WIN32)
    constexpr uid_t nobody = 65534;
    if (::lchown (path.c_str(), nobody, nobody) == 0) return true;
#else
    static_cast<void> (path);
#endif
    WARN ("skipped: only root can give files away");
    return false;
}

}   // namespace tactus::test
