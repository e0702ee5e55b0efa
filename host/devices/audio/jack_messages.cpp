// SPDX-License-Identifier: MIT
#include "jack_messages.hpp"

#if defined(__unix__)
#include <initializer_list>

#include <dlfcn.h>
#endif

namespace tactus::host
{

#if defined(__unix__)
void hushJack() noexcept
{
    using Say = void (*) (const char*);
    const Say nothing = [] (const char*) {};
    void* const library = dlopen ("libjack.so.0", RTLD_LAZY);   // stays loaded, as JUCE's devices expect
    if (library == nullptr) return;
    for (const char* const setter : { "jack_set_error_function", "jack_set_info_function" })
        if (auto* const set = reinterpret_cast<void (*) (Say)> (dlsym (library, setter))) set (nothing);
}
#else
void hushJack() noexcept
{
}
#endif

}   // namespace tactus::host
