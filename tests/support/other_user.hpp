// SPDX-License-Identifier: MIT
#pragma once

#include <catch2/catch.hpp>

#include <filesystem>

#include <unistd.h>

namespace tactus::test
{

/// Gives a file, folder or link to another user. Only root can: otherwise returns false, with a warning that the test is skipped.
inline bool giveAway (const std::filesystem::path& path)
{
    constexpr uid_t nobody = 65534;
    if (::lchown (path.c_str(), nobody, nobody) == 0) return true;
    WARN ("skipped: only root can give files away");
    return false;
}

}   // namespace tactus::test
