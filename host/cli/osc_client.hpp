// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/osc/osc_port.hpp>

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace tactus::host
{

/// `--osc PORT` of the commands that talk to a program that runs.
struct OscOption
{
    int number = OscPort::usual;

    void addTo (CLI::App&);
};

/// Our end of a conversation with a program that runs on this machine.
class OscClient
{
public:
    /// Fails the command if nothing listens there. Ids: osc/nothing_runs.
    explicit OscClient (int number);

    /// The port for answers.
    int own() const noexcept { return answers->number(); }

    void send (const juce::OSCMessage& m) { answers->send (to, m); }

    /// The next answer; fails the command if none comes within some seconds. Ids: osc/no_answer.
    juce::OSCMessage answer();

    /// The next answer if one is there in time.
    std::optional<juce::OSCMessage> next (std::chrono::milliseconds patience) { return answers->next (patience); }

    /// Fails the command if this is an error.
    static void check (const juce::OSCMessage&);

private:
    int to;
    std::unique_ptr<OscPort> answers;
};

}   // namespace tactus::host
