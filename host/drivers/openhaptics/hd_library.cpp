// SPDX-License-Identifier: MIT
#include "hd_library.hpp"

#if defined(_WIN32)
#include <windows.h>
#else
#include <dlfcn.h>
#endif

#include <type_traits>

namespace tactus::host::openhaptics
{

namespace
{
// By the path of the system, as the programs of its maker find it. It stays loaded.
#if defined(_WIN32)
constexpr const char* names[] { "HD.dll" };   // with 32 and 64 bits

void* open (const char* name, std::string& why)
{
    void* library = reinterpret_cast<void*> (::LoadLibraryA (name));
    if (library == nullptr) why = std::string (name) + ": error " + std::to_string (::GetLastError()) + " of Windows";
    return library;
}

void* functionIn (void* library, const char* name) { return reinterpret_cast<void*> (::GetProcAddress (static_cast<HMODULE> (library), name)); }
#else
constexpr const char* names[] { "libHD.so", "libHD.so.3.4", "libHD.so.3.0" };

void* open (const char* name, std::string& why)
{
    void* library = ::dlopen (name, RTLD_LAZY | RTLD_GLOBAL);   // libHD expects that other libraries see its symbols
    if (const char* said = library == nullptr ? ::dlerror() : nullptr; said != nullptr) why = said;
    return library;
}

void* functionIn (void* library, const char* name) { return ::dlsym (library, name); }
#endif
}   // namespace

std::string HdFunctions::load()
{
    std::string why;
    void* library = nullptr;
    for (const auto* name : names)
    {
        std::string said;
        library = open (name, said);
        if (library != nullptr) break;
        why += (why.empty() ? "" : "; ") + said;
    }
    if (library == nullptr) return "the library of OpenHaptics cannot be opened: " + why;
    const auto find = [&] (const char* name, auto& to) {
        to = reinterpret_cast<std::remove_reference_t<decltype (to)>> (functionIn (library, name));   // NOLINT: a function is found as data
        if (to == nullptr) why = std::string ("the library of OpenHaptics lacks ") + name;
    };
    why.clear();
#define TACTUS_FIND(result, name, parameters) find (#name, name);
    TACTUS_HD_FUNCTIONS (TACTUS_FIND)
#undef TACTUS_FIND
    return why;
}

}   // namespace tactus::host::openhaptics
