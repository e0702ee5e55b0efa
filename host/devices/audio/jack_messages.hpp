// SPDX-License-Identifier: MIT
#pragma once

namespace tactus::host
{

/// Keeps JACK's library from printing to stderr from now on: a missing server is not an error while looking for sound
/// cards. Does nothing if there is no such library. [main thread]
void hushJack() noexcept;

}   // namespace tactus::host
