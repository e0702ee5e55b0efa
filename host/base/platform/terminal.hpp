// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>

namespace tactus::host
{

/// True if stderr is a terminal.
bool stderrIsTerminal() noexcept;

/// The number of characters in a row of the terminal of stderr; 0 if it is unknown or no terminal.
int stderrColumns() noexcept;

/// Reads single key presses while it exists; Ctrl-C still works. The destructor restores the terminal (not after a crash).
/// There are no keys if stdin is not a terminal, if it belongs to another program, or without termios. [main thread]
class Keys
{
public:
    Keys();
    ~Keys();
    Keys (const Keys&) = delete;
    Keys& operator= (const Keys&) = delete;

    /// Restores the terminal now, for a program that ends without destructors. [any thread]
    void restore() const noexcept;

    bool areThere() const noexcept { return before != nullptr; }

    /// The next key that is pressed within `patience`; 0 if none is. [any one thread]
    char next (std::chrono::milliseconds patience = {}) noexcept;

private:
    struct SavedMode;
    std::unique_ptr<SavedMode> before;
};

}   // namespace tactus::host
