// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <support/temporary_folder.hpp>

#include <string>
#include <vector>

namespace tactus::test
{

/// A temporary folder whose paths are arguments of a program.
class Scratch
{
public:
    std::string path (const std::string& name) const { return (folder / name).string(); }
    std::string write (const std::string& name, const std::string& text) const;

private:
    TemporaryFolder folder;
};

/// The result of a program run.
struct Ran
{
    int status;
    std::string out, err;
};

/// `tactus`, or the program that TACTUS_TESTED_PROGRAM names: ./test.sh --windows tests tactus.exe in wine by the same tests.
std::string testedProgram();

/// True if the tested program is one of Windows: it prints paths with a \, has no guardian, and opens serial lines by names such as COM20.
bool isOfWindows();

/// A serial line: a pseudo-terminal of Linux.
struct SerialLine
{
    std::string link;   ///< the path of its far end, which a fake device makes
    std::string name;   ///< its name for the tested program
};

/// In wine, a line has to be known before the first program starts, so there is only one.
SerialLine serialLine (const Scratch&);

/// The arguments that play a graph on the device of the stylus, without the bindings of the user. With --untried for Windows, which has no guardian.
std::vector<std::string> playOn (const std::string& device, const std::string& graph, const std::vector<std::string>& more = {});

/// The text with the paths as on Linux.
std::string withSlashes (std::string text);

/// Runs `tactus` or another program with these arguments.
Ran runTactus (const std::vector<std::string>& arguments);
Ran runProgram (const std::string& program, const std::vector<std::string>& arguments);

/// Checks that `tactus` ends with this status and says `words`, and that it does not write this file.
void checkRefused (const std::vector<std::string>& arguments, int status, const std::string& words, const std::string& unwritten);

std::string textOf (const std::string& path);

/// True if the file of a live run has the rows of this other one, to the byte, but for as many as the run says that it has lost: on a busy computer, writing
/// may not keep up with the ticks. WAV files are compared only if nothing was lost.
bool sameRows (const std::string& live, const std::string& again, const std::string& said);

/// The folder ../shared/data; "" if it does not exist, with a warning that the test is skipped.
std::string sharedData (const std::string& folder);

}   // namespace tactus::test
