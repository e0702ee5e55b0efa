// SPDX-License-Identifier: MIT
#include "hd_library.hpp"

#include <dlfcn.h>

#include <type_traits>

namespace tactus::host::openhaptics
{

std::string HdFunctions::load()
{
    std::string why;
    void* library = nullptr;
    // By the path of the system, as the programs of its maker find it. It stays loaded.
    for (const auto* name : { "libHD.so", "libHD.so.3.4", "libHD.so.3.0" })
    {
        library = ::dlopen (name, RTLD_LAZY | RTLD_GLOBAL);   // libHD expects that other libraries see its symbols
        if (library != nullptr) break;
        if (const char* said = ::dlerror(); said != nullptr) why += (why.empty() ? "" : "; ") + std::string (said);
    }
    if (library == nullptr) return "the library of OpenHaptics cannot be opened: " + why;
    const auto find = [&] (const char* name, auto& to) {
        to = reinterpret_cast<std::remove_reference_t<decltype (to)>> (::dlsym (library, name));   // NOLINT: a function is found as data
        if (to == nullptr) why = std::string ("the library of OpenHaptics lacks ") + name;
    };
    why.clear();
#define TACTUS_FIND(result, name, parameters) find (#name, name);
    TACTUS_HD_FUNCTIONS (TACTUS_FIND)
#undef TACTUS_FIND
    return why;
}

}   // namespace tactus::host::openhaptics
