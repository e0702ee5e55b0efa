// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tactus::host
{

/// From now on JACK's library says nothing on stderr: that no server runs is no error while one looks for cards. Where there
/// is no such library it does nothing. [main thread]
void hushJack() noexcept;

}   // namespace tactus::host
