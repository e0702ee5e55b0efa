// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/palette/search.hpp>
#include <tactus/node/catalogue.hpp>

#include <algorithm>
#include <map>
#include <set>

using namespace tactus;
using namespace tactus::host;

namespace
{
std::vector<std::string> typesFor (const std::string& query, const std::vector<std::string>& recent = {})
{
    std::vector<std::string> types;
    for (const auto& e : searchPalette (query, {}, catalogue(), {}, recent))
        types.push_back (e.type);
    return types;
}

bool isAmong (const std::vector<std::string>& types, const std::string& type, std::size_t first)
{
    return std::ranges::find (types, type) - types.begin() < static_cast<std::ptrdiff_t> (std::min (first, types.size()));
}
}   // namespace

TEST_CASE ("palette: a node is among the first three entries for the names that other programs give it")
{
    const std::multimap<std::string, std::string> wanted {
        { "motor", "device.force" },
        { "output", "device.force" },
        { "mouse", "device.position" },
        { "hand", "device.position" },
        { "sine", "signal.lfo" },
        { "LFO", "signal.lfo" },
        { "knob", "signal.constant" },
        { "knob", "signal.gain" },
        { "noise", "signal.noise" },
        { "noise", "texture.noise" },
        { "wall", "deform.plane" },
        { "stick slip", "friction.elasto_plastic" },
        { "mixer", "layer.mix" },
        { "adsr", "signal.envelope" },
        { "lowpass", "filter.butterworth2" },
        { "speed", "motion.velocity" },
        { "formula", "signal.expression" },
    };
    for (const auto& [query, type] : wanted)
    {
        CAPTURE (query, type);
        CHECK (isAmong (typesFor (query), type, 3));
    }
}

TEST_CASE ("palette: a name comes before a keyword, and a keyword before a description")
{
    CHECK (typesFor ("delay").front() == "signal.delay");
    CHECK (typesFor ("gain").front() == "signal.gain");
    const auto types = typesFor ("grating");
    CHECK (types.front() == "texture.grating");
    CHECK (isAmong (typesFor ("N/m"), "deform.plane", 5));   // a unit
}

TEST_CASE ("palette: mistyped and shortened words find what was meant, but only if nothing else fits")
{
    CHECK (typesFor ("gratnig").front() == "texture.grating");
    CHECK (typesFor ("fricton").front().starts_with ("friction."));
    CHECK (isAmong (typesFor ("elpl"), "friction.elasto_plastic", 2));
    CHECK (typesFor ("xyzzy").empty());
    for (const auto& type : typesFor ("mix"))
        CHECK (type != "signal.map");   // one letter away
}

TEST_CASE ("palette: without a query, the recent types come first, then each family under its title")
{
    const auto entries = searchPalette ("", {}, catalogue(), {}, { "signal.lfo", "no.such", "deform.plane" });
    REQUIRE (entries.size() > 4);
    CHECK (entries[0].isTitle());
    CHECK (entries[0].name == "Recent");
    CHECK (entries[1].type == "signal.lfo");
    CHECK (entries[2].type == "deform.plane");
    CHECK (entries[3].isTitle());
    std::string title;
    std::set<std::string> titles, types;
    for (const auto& e : entries)
    {
        if (e.isTitle())
        {
            title = e.name;
            CHECK (titles.insert (title).second);
        }
        else if (title != "Recent")
        {
            CHECK (types.insert (e.type).second);
            CHECK (e.type.substr (1, title.size() - 1) == title.substr (1));
        }
    }
    CHECK (types.size() == static_cast<std::size_t> (std::ranges::distance (catalogue())));
}

TEST_CASE ("palette: the keywords of every node are lower-case words")
{
    for (const auto& type : catalogue())
        for (const char c : type.info.keywords)
        {
            CAPTURE (type.info.id);
            CHECK ((c == ' ' || c == '-' || (c >= 'a' && c <= 'z')));
        }
}

TEST_CASE ("palette: a subgraph is not offered inside itself, nor inside one that it contains")
{
    graph::Graph g;
    const auto node = [] (const char* name, const char* type) {
        graph::Node n;
        n.name = name;
        n.type = type;
        return n;
    };
    for (const char* name : { "outer", "inner", "other" })
        g.graphs.emplace_back (name, graph::Patch {});
    g.graphs[0].second.nodes.push_back (node ("in", "graph:inner"));
    const auto subgraphsIn = [&] (const std::string& patch) {
        std::set<std::string> found;
        for (const auto& e : searchPalette ("", g, catalogue(), {}, {}, patch))
            if (e.type.starts_with ("graph:")) found.insert (e.type.substr (6));
        return found;
    };
    using Names = std::set<std::string>;
    CHECK (subgraphsIn ("") == Names { "outer", "inner", "other" });
    CHECK (subgraphsIn ("outer") == Names { "inner", "other" });
    CHECK (subgraphsIn ("inner") == Names { "other" });
    CHECK (subgraphsIn ("other") == Names { "outer", "inner" });
    g.graphs[1].second.nodes.push_back (node ("back", "graph:outer"));   // broken: it contains itself
    CHECK (subgraphsIn ("other") == Names { "outer", "inner" });
}
