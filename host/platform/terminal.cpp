// SPDX-License-Identifier: GPL-3.0-or-later
#include "terminal.hpp"

#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

namespace tactus::host
{

bool stderrIsTerminal() noexcept
{
#if defined(_WIN32)
    return _isatty (2) != 0;
#else
    return isatty (2) != 0;
#endif
}

}   // namespace tactus::host
