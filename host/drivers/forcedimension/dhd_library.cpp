// SPDX-License-Identifier: MIT
#include "dhd_library.hpp"

#include <tactus/plugin/shared_object.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <sstream>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#if ! defined(_WIN32)
#include <sys/utsname.h>
#endif

namespace tactus::host::forcedimension
{

namespace
{
namespace fs = std::filesystem;

#if defined(_WIN32)
constexpr std::array names { sizeof (void*) == 8 ? "drd64.dll" : "drd.dll", sizeof (void*) == 8 ? "dhd64.dll" : "dhd.dll" };
#else
constexpr std::array names { "libdrd.so", "libdhd.so" };
#endif

/// The folders in which to look.
std::vector<fs::path> folders()
{
    std::vector<fs::path> all;
    const auto add = [&] (const char* variable, const std::string& below) {
        if (const char* value = std::getenv (variable); value != nullptr && value[0] != 0) all.push_back (fs::path (value) / below);
    };
#if defined(_WIN32)
    for (const auto* variable : { "FDSDK", "FORCEDIM_SDK" })
        add (variable, "bin");
    for (const auto* variable : { "LOCALAPPDATA", "ProgramFiles" })
    {
        add (variable, "Force Dimension");
        std::error_code failed;
        if (all.empty()) continue;
        for (fs::directory_iterator at (all.back(), failed), end; ! failed && at != end; at.increment (failed))
            if (at->path().filename().string().starts_with ("sdk-")) all.push_back (at->path() / "bin");
    }
#else
    utsname machine {};
    ::uname (&machine);
    for (const auto* variable : { "FDSDK", "FORCEDIM_SDK" })
        add (variable, "lib/release/lin-" + std::string (machine.machine) + "-gcc");
    const char* listed = std::getenv ("LD_LIBRARY_PATH");
    std::istringstream paths (listed != nullptr ? listed : "");
    for (std::string path; std::getline (paths, path, ':');)
        if (! path.empty()) all.emplace_back (path);
    add ("HOME", ".local/lib");
    all.insert (all.end(), { "/usr/local/lib", "/usr/lib", "/usr/lib/" + std::string (machine.machine) + "-linux-gnu" });
#endif
    return all;
}

/// The files of a folder whose names begin like this, the highest version first. Plain text would put 3.9 before 3.17.
std::vector<fs::path> librariesIn (const fs::path& folder, const std::string& name)
{
    std::error_code failed;
    std::vector<fs::path> found;
    for (fs::directory_iterator at (folder, failed), end; ! failed && at != end; at.increment (failed))
        if (at->path().filename().string().starts_with (name)) found.push_back (at->path());
#if ! defined(_WIN32)   // where a name has no version
    std::ranges::sort (found, [] (const fs::path& a, const fs::path& b) { return ::strverscmp (a.c_str(), b.c_str()) > 0; });
#endif
    return found;
}

DhdLibrary functionsOf (const SharedObject& object)
{
    DhdLibrary f;
    const auto find = [&] (const char* name, auto& to) {
        to = reinterpret_cast<std::remove_reference_t<decltype (to)>> (const_cast<void*> (object.find (name)));   // NOLINT: a function is found as data
    };
#define TACTUS_FIND(result, name, parameters) find (#name, f.name);
    TACTUS_DHD_FUNCTIONS (TACTUS_FIND)
#undef TACTUS_FIND
    if (f.dhdGetOrientationFrame == nullptr) find ("dhdGetRotatorMatrix", f.dhdGetOrientationFrame);   // its name in old versions
    return f;
}
}   // namespace

std::shared_ptr<const DhdLibrary> DhdLibrary::load (std::string& why)
{
    why.clear();
    std::string looked_in;
    for (const auto* name : names)
        for (const auto& folder : folders())
            for (const auto& file : librariesIn (folder, name))
            {
                const auto note = [&] (const std::string& what) { why += (why.empty() ? "" : "; ") + file.string() + ": " + what; };
                auto object = SharedObject::load (file);
                if (! object)
                {
                    note (object.error().text);
                    continue;
                }
                const auto f = functionsOf (**object);
                const bool is_old = f.dhdEnableForce == nullptr || f.dhdGetSDKVersion == nullptr;
                if (! is_old && f.dhdOpenID && f.dhdClose && f.dhdStop && f.dhdErrorGetLast && f.dhdGetStatus && f.dhdGetPosition && f.dhdSetForce)
                {
                    static auto& loaded = *new std::vector<std::unique_ptr<SharedObject>>;   // never destroyed: the library stays loaded
                    static std::mutex mutex;
                    const std::lock_guard lock (mutex);
                    loaded.push_back (std::move (*object));
                    return std::make_shared<const DhdLibrary> (f);
                }
                note (is_old ? "this version is too old: it lacks dhdEnableForce or dhdGetSDKVersion" : "it lacks functions that every version has");
            }
    for (const auto& folder : folders())
        looked_in += (looked_in.empty() ? "" : ", ") + folder.string();
    if (why.empty())
        why = std::string ("install the SDK of Force Dimension, and set FDSDK to its folder: neither ") + names[0] + " nor " + names[1] + " is in " + looked_in;
    return nullptr;
}

std::string DhdLibrary::version() const
{
    std::array<int, 4> v {};
    dhdGetSDKVersion (&v[0], &v[1], &v[2], &v[3]);
    return std::to_string (v[0]) + "." + std::to_string (v[1]) + "." + std::to_string (v[2]);
}

std::string DhdLibrary::lastError() const
{
    const int code = dhdErrorGetLast();
    const char* text = dhdErrorGetStr != nullptr ? dhdErrorGetStr (code) : nullptr;
    return (text != nullptr && text[0] != 0 ? std::string (text) + " " : std::string()) + "(error " + std::to_string (code) + " of its library)";
}

}   // namespace tactus::host::forcedimension
