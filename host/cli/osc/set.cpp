// SPDX-License-Identifier: GPL-3.0-or-later
#include "osc_client.hpp"

#include <host/cli/commands.hpp>
#include <host/cli/report.hpp>

namespace tactus::host
{

namespace
{
struct SetOptions
{
    std::vector<std::string> sets;
    OscOption osc;
};

void run (const SetOptions& options)
{
    for (const auto& set : options.sets)
        if (const auto equals = set.find ('='); equals == std::string::npos || equals == 0)
            throw UsageError ("NODE.PARAM=VALUE", "'" + set + "' has the wrong form; write drag.mu=0.3, board.stiffness=\"2 N/mm\" or roughness=0.7");

    OscClient client { options.osc.number };
    const auto text = [] (const std::string& s) { return juce::String::fromUTF8 (s.c_str(), static_cast<int> (s.size())); };
    bool all_fine = true;
    for (const auto& set : options.sets)
    {
        const auto equals = set.find ('=');
        const auto name = set.substr (0, equals), value = set.substr (equals + 1);
        client.send (juce::OSCMessage (name.find ('.') == std::string::npos ? "/tactus/control" : "/tactus/param", text (name), text (value), client.own()));
        try
        {
            OscClient::check (client.answer());
        }
        catch (const Stop&)
        {
            all_fine = false;   // continues with the remaining values
        }
    }
    if (! all_fine) throw Stop {};
}
}   // namespace

void addSet (const Command& app)
{
    const auto options = std::make_shared<SetOptions>();
    const auto command = app.add ("set", "Set parameters and controls of a graph that `tactus play` is running");
    command.addOption ("values", options->sets, "NODE.PARAM=VALUE, or CONTROL=0…1").required();
    options->osc.addTo (command);
    command.footer ("Takes the same values as --set. A value is reached within 20 ms; the graph file does not change.\n\n"
                    "Examples:\n"
                    "  tactus set drag.mu=0.3\n"
                    "  tactus set drag.d_max=\"20 um\" drag.adhesion=dahl board.normal=[0.1,0,1]\n"
                    "  tactus set roughness=0.7");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
