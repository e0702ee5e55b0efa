// SPDX-License-Identifier: GPL-3.0-or-later
// For tests under ASan that open a window on a display: Xlib keeps a little memory until the process ends, and JUCE unloads it before
// that. Here it stays loaded, so that the leak checker knows whose memory it is, and leaves it out.
#ifdef __clang__
#if __has_feature(address_sanitizer)

#include <dlfcn.h>

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libX11\nleak:libXext\nleak:libXcursor\nleak:libXi\nleak:libXrender\nleak:libxcb\n"; }

[[maybe_unused]] static const bool stays_loaded = [] {
    for (const char* library : { "libX11.so.6", "libXext.so.6", "libXcursor.so.1", "libXi.so.6", "libXrender.so.1" })
        dlopen (library, RTLD_NOW | RTLD_NODELETE);
    return true;
}();

#endif
#endif
