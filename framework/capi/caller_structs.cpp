// SPDX-License-Identifier: MIT
#include "caller_structs.hpp"

#include <cstdio>

namespace tactus::capi
{

namespace
{
thread_local char last_misuse[260] = "";
}

tactus_result misuse (const char* why) noexcept
{
    std::snprintf (last_misuse, sizeof last_misuse, "%s", why);
    return TACTUS_MISUSE;
}

bool hasSize (const Form& form, std::uint32_t size, std::size_t known, tactus_messages* messages) noexcept
{
    if (size >= form.first && size <= known) return true;
    char why[120], remedy[120];
    if (size == 0)
        std::snprintf (why, sizeof why, "the size of a %s is 0, so it is not initialised", form.name);
    else
        std::snprintf (why, sizeof why, "the size of a %s is %u, but this library knows sizes from %u to %u", form.name, unsigned { size },
                       static_cast<unsigned> (form.first), static_cast<unsigned> (known));
    std::snprintf (remedy, sizeof remedy, "begin with %s x = %s;%s", form.name, form.initialiser,
                   size > known ? " a program that was built against a newer version needs its library" : "");
    std::snprintf (last_misuse, sizeof last_misuse, "%s: %s", why, remedy);
    if (messages == nullptr) return false;
    try
    {
        messages->list.push_back (Message::error ("api/struct", form.name, why, remedy));
    }
    catch (...)   // without memory, the result and tactus_last_misuse still say it
    {
    }
    return false;
}

}   // namespace tactus::capi

const char* tactus_last_misuse (void) { return tactus::capi::last_misuse; }
