// SPDX-License-Identifier: MIT
#include "load_fused.hpp"

#include <tactus/plugin/shared_object.hpp>

#include <utility>

#if defined(__linux__)
#include <dlfcn.h>
#include <link.h>
#include <unistd.h>
#endif

namespace tactus::host
{

namespace
{
#if defined(__linux__)
/// The segments of a shared object that begins at this address.
int touchSegments (dl_phdr_info* object, std::size_t, void* base)
{
    if (object->dlpi_addr != reinterpret_cast<ElfW (Addr)> (base)) return 0;
    const auto page = static_cast<std::size_t> (::sysconf (_SC_PAGESIZE));
    for (int i = 0; i < object->dlpi_phnum; ++i)
    {
        const auto& segment = object->dlpi_phdr[i];
        if (segment.p_type != PT_LOAD || (segment.p_flags & PF_R) == 0) continue;
        const auto* bytes = reinterpret_cast<const volatile unsigned char*> (object->dlpi_addr + segment.p_vaddr);
        for (std::size_t at = 0; at < segment.p_filesz; at += page)
            (void)bytes[at];
    }
    return 1;
}

/// Reads each page of the shared object with this function, so that the first tick need not wait for the disk.
void touchPagesOf (const void* function)
{
    Dl_info found {};
    if (::dladdr (function, &found) != 0) ::dl_iterate_phdr (&touchSegments, found.dli_fbase);
}
#else
void touchPagesOf (const void*)
{
}
#endif
}   // namespace

Result<std::shared_ptr<const FusedTick>> loadFused (const std::filesystem::path& file, std::vector<void*> objects, const char* name)
{
    static auto& loaded = *new std::vector<std::shared_ptr<const SharedObject>>;   // never freed: see the comment in the header
    auto object = SharedObject::load (file);
    if (! object)
        return Message::error ("fuse/cannot_load", {}, "the fused code cannot be loaded, so the graph is not fused: " + object.error().text,
                               "the run continues as it is");
    const auto* function = (*object)->find (name);
    std::shared_ptr<const SharedObject> kept = std::move (*object);
    loaded.push_back (kept);
    if (function == nullptr)
        return Message::error ("fuse/cannot_load", {}, "the fused code has no function " + std::string (name) + ", so the graph is not fused",
                               "the run continues as it is");
    touchPagesOf (function);
    using Tick = void (*) (void* const*) noexcept;
    return std::make_shared<const FusedTick> (FusedTick { reinterpret_cast<Tick> (const_cast<void*> (function)), std::move (objects), std::move (kept) });
}

}   // namespace tactus::host
