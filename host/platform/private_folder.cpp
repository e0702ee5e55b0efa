// SPDX-License-Identifier: GPL-3.0-or-later
#include "private_folder.hpp"

#if defined(_WIN32)
#include <random>
#else
#include <stdlib.h>
#endif

namespace tactus::host
{

namespace fs = std::filesystem;

fs::path temporaryFolder()
{
    std::error_code failed;
    auto folder = fs::temp_directory_path (failed);
#if ! defined(_WIN32)
    if (failed) folder = "/tmp";
#endif
    return folder;
}

fs::path privateFolder (const std::string& name)
{
#if defined(_WIN32)
    std::error_code failed;
    const auto folder = temporaryFolder() / (name + std::to_string (std::random_device {}()));
    return fs::create_directory (folder, failed) ? folder : fs::path();
#else
    auto path = (temporaryFolder() / (name + "XXXXXX")).string();
    return ::mkdtemp (path.data()) != nullptr ? fs::path (path) : fs::path();
#endif
}

}   // namespace tactus::host
