// SPDX-License-Identifier: GPL-3.0-or-later
#include "osc_client.hpp"
#include "report.hpp"

namespace tactus::host
{

void OscOption::addTo (CLI::App& app)
{
    app.add_option ("--osc", number, "The UDP port that it listens on, on this machine; " + std::to_string (OscPort::usual) + " if nothing is said")->check (CLI::Range (1, 65535));
}

OscClient::OscClient (int number) : to (number)
{
    if (! OscPort::isTaken (number))
        fail ({ "osc/nothing_runs", "127.0.0.1:" + std::to_string (number), "no program listens there", "start one with `tactus play GRAPH`; its first line says where it listens" });
    answers = orFail (OscPort::open (0));
}

juce::OSCMessage OscClient::answer()
{
    using namespace std::chrono_literals;
    if (auto message = answers->next (10s)) return std::move (*message);
    fail ({ "osc/no_answer", "127.0.0.1:" + std::to_string (to), "what listens there does not answer", "is it `tactus play`? Its first line says where it listens; give that as --osc PORT" });
}

void OscClient::check (const juce::OSCMessage& m)
{
    if (m.getAddressPattern().toString() != "/tactus/error") return;
    const auto text = [&] (int i)
    { return m.size() > i && m[i].isString() ? m[i].getString().toStdString() : std::string(); };
    fail ({ text (2), text (1), text (3), text (4) });
}

}   // namespace tactus::host
