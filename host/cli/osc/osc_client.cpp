// SPDX-License-Identifier: GPL-3.0-or-later
#include "osc_client.hpp"

#include <host/cli/report.hpp>
#include <host/devices/osc/token_file.hpp>

namespace tactus::host
{

void OscOption::addTo (const Command& app)
{
    const auto about = "The UDP port of the running program on this machine; default: " + std::to_string (OscPort::usual);
    app.addOption ("--osc", number, about).check (within (1, 65535));
}

OscClient::OscClient (int number) : to (number)
{
    if (! OscPort::isTaken (number))
        fail (Message::error ("osc/nothing_runs", "127.0.0.1:" + std::to_string (number), "no program is listening on this port",
                              "start one with `tactus play GRAPH`; its first line shows the port"));
    answers = orFail (OscPort::open (0));
    if (const auto token = TokenFile::read (number); ! token.empty()) send (juce::OSCMessage ("/tactus/hello", juce::String (token)));
}

OscClient::~OscClient() { send (juce::OSCMessage ("/tactus/hello")); }

juce::OSCMessage OscClient::answer()
{
    using namespace std::chrono_literals;
    if (auto message = answers->next (10s)) return std::move (*message);
    fail (Message::error ("osc/no_answer", "127.0.0.1:" + std::to_string (to), "the program listening on this port does not answer",
                          "give --osc PORT with the port that the first line of `tactus play` shows"));
}

void OscClient::check (const juce::OSCMessage& m)
{
    if (m.getAddressPattern().toString() != "/tactus/error") return;
    const auto text = [&] (int i) { return m.size() > i && m[i].isString() ? m[i].getString().toStdString() : std::string(); };
    fail (Message::error (text (2), text (1), text (3), text (4)));
}

void OscClient::failSilent (const std::string& where, bool has_answered)
{
    const std::string remedy = "check whether `tactus play` is still running";
    if (has_answered) fail (Message::error ("osc/gone", where, "nothing has arrived from this port for 10 s", remedy));
    fail (Message::error ("osc/no_answer", where, "the program listening on this port does not answer", remedy));
}

}   // namespace tactus::host
