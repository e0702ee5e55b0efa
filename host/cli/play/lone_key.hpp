// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

namespace tactus::host
{

/// Tells a letter that a person has typed from one that is part of something else: of the sequence that a terminal sends for a key such as F3
/// (Esc O R) or in answer to a question of another program (Esc [ 24 ; 80 R), of pasted text, or of a key that is held down. Only a letter that
/// comes alone counts. Times are on the steady clock, in s.
class LoneKey
{
public:
    static constexpr double alone_s = 0.05;   ///< nothing else may come within this time before and after; people type more slowly
    static constexpr double escape_s = 0.5;   ///< the rest of an escape sequence may come this late, over a slow network
    static constexpr double repeat_s = 0.7;   ///< a letter that follows the same one within this time comes from a key held down

    /// In lower case; in upper case it counts, too.
    explicit LoneKey (char l) noexcept : letter (l) {}

    /// Takes a byte from the terminal.
    void typed (char key, double now) noexcept
    {
        constexpr int lower_case = 0x20;
        const bool is_it = (key | lower_case) == letter;
        waits = is_it && now > last + alone_s && now > escape + escape_s && now > last_of_it + repeat_s;
        last = now;
        if (is_it) last_of_it = now;
        if (key == '\x1b') escape = now;
    }

    /// True once for each letter that counts. Call it when the terminal has nothing more to read.
    bool isDue (double now) noexcept
    {
        if (! waits || now < last + alone_s) return false;
        waits = false;
        return true;
    }

private:
    static constexpr double never = -std::numeric_limits<double>::infinity();

    char letter;
    double last = never, last_of_it = never, escape = never;
    bool waits = false;   // the last byte was a letter that counts if nothing follows
};

}   // namespace tactus::host
