// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "report.hpp"

#include <host/base/platform/start_program.hpp>

namespace tactus::host
{

void addCheckPlugin (const Command& app)
{
    const auto command = app.add ("check-plugin", "Check that the nodes or the device driver of a plugin meet all requirements");
    command.passOn ([] (const std::vector<std::string>& arguments) {
        const auto program = besideThisProgram ("tactus-check-plugin");
        const auto why = becomeProgram (program, arguments);
        fail (Message::error ("check_plugin/not_built", program.string(), "cannot be started: " + why, "build the target tactus-check-plugin (Linux)"));
    });
}

}   // namespace tactus::host
