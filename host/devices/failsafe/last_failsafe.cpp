// SPDX-License-Identifier: MIT
#include "last_failsafe.hpp"

#include <host/base/platform/home_folder.hpp>
#include <host/base/platform/private_folder.hpp>

#include <tactus/text/quote.hpp>

#include <fstream>

namespace tactus::host
{

std::filesystem::path lastFailsafeFile()
{
    const auto home = homeFolder();
    return ! home.empty() && needOwnFolder (home) ? std::filesystem::absolute (home) / "last_failsafe.txt" : std::filesystem::path {};
}

std::string lastFailsafe()
{
    const auto home = homeFolder();
    std::error_code error;
    if (home.empty() || ! std::filesystem::is_regular_file (home / "last_failsafe.txt", error)) return {};
    constexpr std::size_t longest = 100;   // the guardian's lines are shorter
    std::string line (longest, '\0');
    std::ifstream in (home / "last_failsafe.txt");
    in.read (line.data(), static_cast<std::streamsize> (line.size()));
    line.resize (static_cast<std::size_t> (in.gcount()));
    return printable (line.substr (0, line.find ('\n')));
}

}   // namespace tactus::host
