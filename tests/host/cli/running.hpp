// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "program.hpp"
#include "support/waiting.hpp"

namespace tactus::test
{

/// A program that runs at the same time as the test. It is ended when this object is destroyed.
class Running
{
public:
    Running (const std::string& program, const std::vector<std::string>& arguments);
    explicit Running (const std::vector<std::string>& arguments) : Running (testedProgram(), arguments) {}
    ~Running();
    Running (const Running&) = delete;
    Running& operator= (const Running&) = delete;

    std::string err() const { return textOf (scratch.path ("err")); }
    std::string out() const { return textOf (scratch.path ("out")); }

    /// Waits until the program has printed this text to stderr the given number of times, even on a busy machine. Returns
    /// false if it never does.
    bool says (const std::string& text, int times = 1);

    void signal (int number);
    long id() const noexcept { return process; }   ///< process id

    /// Stops the program as Ctrl-C does, and waits until it ends.
    Ran stop();

    /// Waits until the program ends on its own.
    Ran finish();

private:
    Scratch scratch;
    long process = -1;
};

/// As eventually(), with naps that leave the processor to the program.
template <typename F>
bool soon (F&& so)
{
    return eventually (std::chrono::milliseconds (20), so);
}

}   // namespace tactus::test
