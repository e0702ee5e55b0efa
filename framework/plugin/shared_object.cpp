// SPDX-License-Identifier: MIT
#include "shared_object.hpp"

#include <tactus/text/ownership.hpp>
#include <tactus/text/quote.hpp>

#include <system_error>

#if defined(_WIN32)
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace tactus
{

Result<std::unique_ptr<SharedObject>> SharedObject::load (const std::filesystem::path& file)
{
    std::error_code unseen;
    if (const auto status = std::filesystem::status (file, unseen); std::filesystem::exists (status) && ! std::filesystem::is_regular_file (status))
        return Message::error ("plugin/cannot_load", file.string(), "this is not a file, but a folder, a pipe or a device", "name the file of a plugin");
    auto trusted = TrustedFile::open (file);
    if (! trusted && trusted.error().id == "file/foreign")
        return Message::error ("plugin/foreign", file.string(), trusted.error().text + ", so it is not loaded: its code could do all that you may do",
                               "if you trust it, load a copy of your own, or change its owner or its permissions (chown, chmod go-w)");
    if (! trusted)
        return Message::error ("plugin/cannot_load", file.string(), "the file cannot be read: " + trusted.error().text, "check its name and its permissions");
#if defined(_WIN32)
    void* handle = LoadLibraryW (file.c_str());
    const std::string why = handle == nullptr ? "Windows error " + std::to_string (GetLastError()) : "";
#else
    // Resolves all symbols now, so that no tick has to, and hides them from other plugins.
    void* handle = ::dlopen (trusted->path().c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle != nullptr) trusted->keepPath();
    const char* said = handle == nullptr ? ::dlerror() : nullptr;
    const std::string why = said != nullptr ? said : "";
#endif
    if (handle == nullptr)
        return Message::error ("plugin/cannot_load", file.string(), "the system cannot load the plugin: " + why, "build it for this system, or remove it");
    return std::unique_ptr<SharedObject> (new SharedObject (handle));
}

SharedObject::~SharedObject()
{
#if defined(_WIN32)
    FreeLibrary (static_cast<HMODULE> (handle));
#else
    ::dlclose (handle);
#endif
}

const void* SharedObject::find (const char* symbol) const noexcept
{
#if defined(_WIN32)
    return reinterpret_cast<const void*> (GetProcAddress (static_cast<HMODULE> (handle), symbol));
#else
    return ::dlsym (handle, symbol);
#endif
}

}   // namespace tactus
