// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "report.hpp"

#include <host/base/platform/start_program.hpp>

namespace tactus::host
{

void addBench (const Command& app)
{
    const auto command = app.add ("bench", "Compare Tactus with hand-written code, JUCE and Faust on this machine");
    command.passOn ([] (const std::vector<std::string>& arguments) {
        const auto program = besideThisProgram ("tactus-bench");
        const auto why = becomeProgram (program, arguments);
        fail (Message::error ("bench/not_built", program.string(), "cannot be started: " + why, "build the target tactus-bench"));
    });
}

}   // namespace tactus::host
