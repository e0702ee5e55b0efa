// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "report.hpp"

#include <host/base/platform/start_program.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace tactus::host
{

void addBench (const Command& app)
{
    const auto command = app.add ("bench", "Compare Tactus with hand-written code, JUCE and Faust on this machine");
    command.passOn ([] (const std::vector<std::string>& arguments) {
        const auto program = besideThisProgram ("tactus-bench");
        std::error_code unseen;
        const bool wants_help = std::ranges::any_of (arguments, [] (const std::string& a) { return a == "--help" || a == "-h"; });
        if (wants_help && ! std::filesystem::exists (program, unseen))
        {
            std::cout << "Compare Tactus with hand-written code, JUCE and Faust on this machine\n\n"
                         "The program that does this, tactus-bench, is not next to this one, so its options are not known here. "
                         "Build the target tactus-bench.\n";
            return;
        }
        const auto why = becomeProgram (program, arguments);
        fail (Message::error ("bench/not_built", program.string(), "cannot be started: " + why, "build the target tactus-bench"));
    });
}

}   // namespace tactus::host
