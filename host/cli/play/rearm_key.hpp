// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

namespace tactus::host
{

/// Tells an R that a person has typed from one that is part of something else: of the sequence that a terminal sends for F3 (Esc O R) or
/// in answer to a question of another program (Esc [ 24 ; 80 R), of pasted text, or of a key that is held down. Only an R that
/// comes alone counts. Times are on the steady clock, in s.
class RearmKey
{
public:
    static constexpr double alone_s = 0.05;   ///< nothing else may come within this time before and after; people type more slowly
    static constexpr double escape_s = 0.5;   ///< the rest of an escape sequence may come this late, over a slow network
    static constexpr double repeat_s = 0.7;   ///< an R that follows another one within this time comes from a key held down

    /// Takes a byte from the terminal.
    void typed (char key, double now) noexcept
    {
        const bool is_r = key == 'r' || key == 'R';
        const bool counts = is_r && now > last + alone_s && now > escape + escape_s && now > last_r + repeat_s;
        waits = counts;
        last = now;
        if (is_r) last_r = now;
        if (key == '\x1b') escape = now;
    }

    /// True once for each R that counts. Call it when the terminal has nothing more to read.
    bool isDue (double now) noexcept
    {
        if (! waits || now < last + alone_s) return false;
        waits = false;
        return true;
    }

private:
    static constexpr double never = -std::numeric_limits<double>::infinity();

    double last = never, last_r = never, escape = never;
    bool waits = false;   // the last byte was an R that counts if nothing follows
};

}   // namespace tactus::host
