// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace tactus::host
{

/// The token of a run, in a file that only this user can read, so that `tactus set`, `probe` and `hit` of the same user find it. It is named after
/// the OSC port, in XDG_RUNTIME_DIR, or in the folder of the settings if there is none. Removed with this object. [main thread]
class TokenFile
{
public:
    TokenFile (int port, const std::string& token);
    ~TokenFile();
    TokenFile (const TokenFile&) = delete;
    TokenFile& operator= (const TokenFile&) = delete;

    static std::filesystem::path pathOf (int port);   ///< empty if there is no such folder
    static std::string read (int port);               ///< empty if there is no such file, or if someone else could have written it

private:
    std::filesystem::path file;   // empty if it could not be written
};

}   // namespace tactus::host
