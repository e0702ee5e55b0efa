// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/command_line/command.hpp>
#include <host/devices/osc/osc_port.hpp>

#include <memory>
#include <string>

namespace tactus::host
{

/// The option `--osc PORT` of the commands that talk to a running program.
struct OscOption
{
    int number = OscPort::usual;

    void addTo (const Command&);
};

/// The client's end of a conversation with a program that is running on this machine. It gives the token of that run, if this user started it.
class OscClient
{
public:
    /// Fails the command if no program is listening on the port. Ids: osc/nothing_runs.
    explicit OscClient (int number);
    ~OscClient();
    OscClient (const OscClient&) = delete;
    OscClient& operator= (const OscClient&) = delete;

    /// The port for answers.
    int own() const noexcept { return answers->number(); }

    void send (const juce::OSCMessage& m) { answers->send (to, m); }

    /// The next answer; fails the command if no answer arrives within 10 s. Ids: osc/no_answer.
    juce::OSCMessage answer();

    /// The next answer; empty if none arrives within this time.
    std::optional<juce::OSCMessage> next (std::chrono::milliseconds patience) { return answers->next (patience); }

    /// Fails the command if the answer is an error.
    static void check (const juce::OSCMessage&);

    /// Fails the command because nothing has arrived for a long time. Ids: osc/no_answer; osc/gone if the program has answered before.
    [[noreturn]] static void failSilent (const std::string& where, bool has_answered);

private:
    int to;
    std::unique_ptr<OscPort> answers;
};

}   // namespace tactus::host
