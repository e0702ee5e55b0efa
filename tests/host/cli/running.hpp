// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "program.hpp"

#include <functional>

namespace tactus::test
{

/// A program that runs beside the test. Ended with it.
class Running
{
public:
    Running (const std::string& program, const std::vector<std::string>& arguments);
    explicit Running (const std::vector<std::string>& arguments) : Running (TACTUS_PROGRAM, arguments) {}
    ~Running();
    Running (const Running&) = delete;
    Running& operator= (const Running&) = delete;

    std::string err() const { return textOf (scratch.path ("err")); }
    std::string out() const { return textOf (scratch.path ("out")); }

    /// Waits until the program has said this on stderr (so often), on however busy a machine. False if it never does.
    bool says (const std::string& text, int times = 1);

    void signal (int number);
    long id() const noexcept { return process; }   ///< as the system numbers it

    /// Asks it to stop, as Ctrl-C does, and waits until it has.
    Ran stop();

    /// Waits until it ends by itself.
    Ran finish();

private:
    Scratch scratch;
    long process = -1;
};

/// True as soon as it is; false if it has not come true after half a minute.
bool eventually (const std::function<bool()>&);

}   // namespace tactus::test
