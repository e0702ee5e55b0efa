// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string>
#include <type_traits>

#if defined(_WIN32)
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace tactus::host
{

/// A library that others make, found by the path of the system, as their own programs find it. It stays loaded.
class MakersLibrary
{
public:
    /// The first one of these that can be opened.
    explicit MakersLibrary (std::initializer_list<const char*> names)
    {
        for (const auto* name : names)
        {
#if defined(_WIN32)
            handle = reinterpret_cast<void*> (::LoadLibraryA (name));
            if (handle == nullptr) note (std::string (name) + ": error " + std::to_string (::GetLastError()) + " of Windows");
#else
            handle = ::dlopen (name, RTLD_LAZY | RTLD_GLOBAL);   // some expect that other libraries see their symbols
            if (const char* said = handle == nullptr ? ::dlerror() : nullptr; said != nullptr) note (said);
#endif
            if (handle != nullptr) break;
        }
        reason = handle != nullptr ? std::string() : "cannot be opened: " + reason;
    }

    /// The reason why it cannot be used, in the words of the system, after its name; empty: it can.
    const std::string& why() const { return reason; }

    /// Takes a function; null if it is not there.
    template <typename Function>
    bool find (const char* name, Function& to) const
    {
#if defined(_WIN32)
        auto* found = reinterpret_cast<void*> (::GetProcAddress (static_cast<HMODULE> (handle), name));
#else
        void* found = handle != nullptr ? ::dlsym (handle, name) : nullptr;
#endif
        to = reinterpret_cast<std::remove_reference_t<Function>> (found);   // NOLINT: a function is found as data
        return to != nullptr;
    }

    /// The same for one without which the library is of no use.
    template <typename Function>
    void need (const char* name, Function& to)
    {
        if (! find (name, to) && handle != nullptr && reason.empty()) reason = std::string ("lacks ") + name;
    }

private:
    void note (const std::string& what) { reason += (reason.empty() ? "" : "; ") + what; }

    void* handle = nullptr;
    std::string reason;
};

}   // namespace tactus::host

// A list X (RESULT, NAME, (PARAMETERS)) … of a library's functions becomes pointers to them, and finds them in `library`.
#define TACTUS_FUNCTION_OF_LIBRARY(result, name, parameters) result (*name) parameters = nullptr;
#define TACTUS_NEED_IN_LIBRARY(result, name, parameters) library.need (#name, name);
