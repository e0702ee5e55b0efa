// SPDX-License-Identifier: MIT
#pragma once

namespace tactus::host
{

/// True once the thread that runs main() has ended by pthread_exit, while other threads of the process go on. False on systems that do not tell:
/// only Linux with /proc does. It reads a file. [any thread but the tick thread]
bool mainThreadHasEnded() noexcept;

}   // namespace tactus::host
