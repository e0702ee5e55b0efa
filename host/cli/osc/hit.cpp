// SPDX-License-Identifier: GPL-3.0-or-later
#include "osc_client.hpp"

#include <host/cli/commands.hpp>
#include <host/cli/report.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

#include <utility>

namespace tactus::host
{

namespace
{
struct HitOptions
{
    std::vector<std::string> hits;
    OscOption osc;
};

constexpr double usual_speed = 1.0;   // m/s

/// Parses NODE.PORT[=SPEED].
std::pair<std::string, float> readHit (const std::string& text)
{
    const auto equals = text.find ('=');
    const auto name = text.substr (0, equals);
    double speed = usual_speed;
    bool right = name.find ('.') != name.npos;
    if (equals != text.npos)
    {
        const auto read = wholeNumber (std::string_view (text).substr (equals + 1));
        speed = read.value_or (0.0);
        right = right && read;
    }
    if (! right) throw UsageError ("NODE.PORT[=SPEED]", quote (text) + " has the wrong form; write ring.hit or ring.hit=0.4 (m/s)");
    return { name, static_cast<float> (speed) };
}

void run (const HitOptions& options)
{
    std::vector<std::pair<std::string, float>> hits;
    for (const auto& text : options.hits)
        hits.push_back (readHit (text));

    OscClient client { options.osc.number };
    for (const auto& [name, speed] : hits)
    {
        client.send (juce::OSCMessage ("/tactus/hit", juce::String::fromUTF8 (name.c_str()), speed, client.own()));
        OscClient::check (client.answer());
    }
}
}   // namespace

void addHit (const Command& app)
{
    const auto options = std::make_shared<HitOptions>();
    const auto command = app.add ("hit", "Trigger hits in a graph that `tactus play` is running");
    command.addOption ("hits", options->hits, "NODE.PORT, or NODE.PORT=SPEED in m/s; default: 1 m/s").required();
    options->osc.addTo (command);
    command.footer ("A hit lasts one tick. Its speed is added to the value that the wires give the port.\n\n"
                    "Examples:\n"
                    "  tactus hit ring.hit\n"
                    "  tactus hit ring.hit=0.4 click.hit=2");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
