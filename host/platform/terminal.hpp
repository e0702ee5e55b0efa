// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

namespace tactus::host
{

/// True if a person reads what is written to stderr.
bool stderrIsTerminal() noexcept;

/// What a person types, key by key, while this lives; Ctrl-C is still what it is. The terminal is as before afterwards, unless
/// the program crashes. There are no keys where stdin is no terminal, or belongs to another program now, or on a system
/// without termios. [main thread]
class Keys
{
public:
    Keys();
    ~Keys();
    Keys (const Keys&) = delete;
    Keys& operator= (const Keys&) = delete;

    bool areThere() const noexcept { return before != nullptr; }

    /// The next one that was pressed; 0 if none was. Does not wait.
    char next() noexcept;

private:
    struct Before;
    std::unique_ptr<Before> before;
};

}   // namespace tactus::host
