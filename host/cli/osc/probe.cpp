// SPDX-License-Identifier: GPL-3.0-or-later
#include "float_text.hpp"
#include "osc_client.hpp"
#include "triggered_probe.hpp"

#include <host/base/platform/signals.hpp>
#include <host/cli/commands.hpp>
#include <host/cli/report.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <chrono>
#include <iostream>
#include <memory>
#include <optional>

namespace tactus::host
{

namespace
{
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

struct ProbeOptions
{
    std::string port;
    double rate_hz = 50.0, duration_s = 0.0;
    TriggerOptions trigger;
    OscOption osc;
};

void run (const ProbeOptions& options)
{
    watchForStop();
    OscClient client { options.osc.number };
    if (! options.trigger.watched.empty())
    {
        auto trigger = options.trigger;
        trigger.duration_s = options.duration_s;
        return probeTriggered (client, options.port, trigger);
    }
    const auto subscribe = [&] {
        const auto port = juce::String::fromUTF8 (options.port.c_str());
        client.send (juce::OSCMessage ("/tactus/probe", port, client.own(), static_cast<float> (options.rate_hz), 5.0f));
    };

    subscribe();
    auto renewed = Clock::now(), heard = renewed;
    double rate_hz = 0.0;
    std::optional<juce::int32> first;
    while (! stopRequested() && std::cout)
    {
        const auto now = Clock::now();
        if (now - renewed > 2s)
        {
            subscribe();
            renewed = now;
        }
        if (now - heard > 10s)
            OscClient::failSilent ("127.0.0.1:" + std::to_string (options.osc.number), rate_hz > 0.0);
        const auto m = client.next (100ms);
        if (! m) continue;
        OscClient::check (*m);

        const auto address = m->getAddressPattern().toString();
        if (address == "/tactus/done" && m->size() >= 3 && (*m)[2].isFloat32() && rate_hz == 0.0)
        {
            rate_hz = (*m)[2].getFloat32();
            heard = Clock::now();
            std::cout << 't';
            for (int i = 3; i < m->size(); ++i)
                if ((*m)[i].isString()) std::cout << ',' << printableName ((*m)[i].getString().toStdString());
            std::cout << std::endl;
        }
        if (address != "/tactus/value" || rate_hz == 0.0 || m->size() < 2 || ! (*m)[1].isInt32()) continue;

        heard = Clock::now();
        const auto tick = (*m)[1].getInt32();
        if (! first) first = tick;
        if (options.duration_s > 0.0 && tick - *first > options.duration_s * rate_hz) break;
        std::cout << numberText (tick / rate_hz);
        for (int i = 2; i < m->size(); ++i)
            if ((*m)[i].isFloat32()) std::cout << ',' << floatText ((*m)[i].getFloat32());
        std::cout << std::endl;   // flushes: a person, or a program at the other end of a pipe, may be watching
    }
}
}   // namespace

void addProbe (const Command& app)
{
    const auto options = std::make_shared<ProbeOptions>();
    const auto command = app.add ("probe", "Watch a port of a graph that `tactus play` is running, as CSV");
    command.addOption ("port", options->port, "The port, as in drag.force, or one of its components, as in drag.force.x").required();
    const auto rate = command.addOption ("--rate", options->rate_hz, "Rows per second").check (within (0.01, 1000.0));
    command.addOption ("--duration", options->duration_s, "How long to watch, in s of the run; default: until Ctrl-C").check (within (1e-3, 1e9));
    const auto trigger = command.addOption ("--trigger", options->trigger.watched, "Print only one window around an edge of this port, with every tick");
    trigger.excludes (rate);
    const auto with_trigger = [&] (Option option) { option.needs (trigger); };
    const auto level = command.addOption ("--level", options->trigger.level, "The level that defines the edge, in the unit of that port");
    trigger.needs (level);
    with_trigger (level);
    const auto edge = command.addOption ("--edge", options->trigger.edge, "rising (from below to the level or above), falling, or either");
    with_trigger (edge.check (oneOf ({ "rising", "falling", "either" })));
    with_trigger (command.addOption ("--before", options->trigger.before, "Ticks to print before the edge; default: 100").check (within (0, 65535)));
    with_trigger (command.addOption ("--after", options->trigger.after, "Ticks to print after the edge; default: 400").check (within (0, 65535)));
    options->osc.addTo (command);
    command.footer ("Values have single precision, and some may be missing; `tactus play --record` keeps every value at full precision.\n"
                    "With --trigger, t is 0 at the edge.\n\n"
                    "Examples:\n"
                    "  tactus probe drag.force\n"
                    "  tactus probe drag.deflection.x --rate 200 --duration 5 > deflection.csv\n"
                    "  tactus probe drag.force --trigger drag.state --level 1.5 --before 50 --after 200");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
