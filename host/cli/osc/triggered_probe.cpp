// SPDX-License-Identifier: GPL-3.0-or-later
#include "triggered_probe.hpp"
#include "float_text.hpp"

#include <host/base/platform/signals.hpp>
#include <host/cli/report.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <chrono>
#include <cstdio>
#include <iostream>
#include <map>
#include <optional>
#include <vector>

namespace tactus::host
{

namespace
{
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// A window, assembled from several messages.
struct Window
{
    /// Adds the rows of a message. Rows that belong to a different edge restart the window; this happens after the graph is edited.
    void add (const juce::OSCMessage& m, std::size_t components)
    {
        constexpr int fixed = 4;
        for (int i = 1; i < fixed; ++i)
            if (m.size() <= fixed || ! m[i].isInt32()) return;
        if (m[1].getInt32() != tick || rows.empty())
        {
            tick = m[1].getInt32();
            ticks = m[2].getInt32();
            rows.clear();
        }
        for (int i = fixed, row = m[3].getInt32(); i + static_cast<int> (components) <= m.size(); ++row)
        {
            auto& values = rows[row];
            for (values.clear(); values.size() < components; ++i)
                values.push_back (m[i].isFloat32() ? m[i].getFloat32() : 0.0f);
        }
    }

    bool isWhole() const { return ! rows.empty() && rows.size() == static_cast<std::size_t> (ticks); }

    int tick = 0, ticks = 0;
    std::map<int, std::vector<float>> rows;   // keyed by the tick relative to the edge
};

void print (const Window& window, const juce::OSCMessage& done, double rate_hz)
{
    std::cout << 't';
    for (int i = 3; i < done.size(); ++i)
        if (done[i].isString()) std::cout << ',' << printableName (done[i].getString().toStdString());
    std::cout << '\n';
    for (const auto& [row, values] : window.rows)
    {
        std::cout << numberText (row / rate_hz);
        for (const float v : values)
            std::cout << ',' << floatText (v);
        std::cout << '\n';
    }
    std::fprintf (stderr, "triggered at %s s of the run\n", numberText (window.tick / rate_hz).c_str());
}
}   // namespace

void probeTriggered (OscClient& client, const std::string& port, const TriggerOptions& options)
{
    const auto text = [] (const std::string& s) { return juce::String::fromUTF8 (s.c_str()); };
    constexpr float patience_s = 5.0f, at_once_s = 1e-3f;
    const auto ask = [&] (float wait_s) {
        client.send (juce::OSCMessage ("/tactus/trigger", text (port), client.own(), text (options.watched), static_cast<float> (options.level),
                                       text (options.edge), options.before, options.after, wait_s));
    };

    ask (patience_s);
    std::optional<juce::OSCMessage> done;
    Window window;
    const auto begin = Clock::now();
    const auto since = [] (Clock::time_point then) { return std::chrono::duration<double> (Clock::now() - then).count(); };
    for (auto asked = begin, heard = begin; ! window.isWhole() && ! stopRequested();)
    {
        if (since (asked) > 2.0 && window.rows.empty())
        {
            ask (patience_s);   // renews the trigger; the answer shows that the program still runs
            asked = Clock::now();
        }
        if (since (heard) > 10.0) OscClient::failSilent (port, done.has_value());
        if (options.duration_s > 0.0 && since (begin) > options.duration_s && window.rows.empty())
        {
            ask (at_once_s);   // releases the trigger, so that other clients may use it
            fail (Message::error ("probe/no_edge", options.watched,
                                  "there was no edge at " + numberText (options.level) + " within " + numberText (options.duration_s) + " s",
                                  "choose another --level or --edge, or wait longer; `tactus probe " + options.watched + "` shows its values"));
        }

        const auto m = client.next (100ms);
        if (! m) continue;
        OscClient::check (*m);
        heard = Clock::now();
        const auto address = m->getAddressPattern().toString();
        if (address == "/tactus/done" && m->size() > 3 && (*m)[2].isFloat32()) done = *m;
        if (address == "/tactus/capture" && done) window.add (*m, static_cast<std::size_t> (done->size() - 3));
    }
    if (window.isWhole())
        print (window, *done, (*done)[2].getFloat32());
    else
        ask (at_once_s);
}

}   // namespace tactus::host
