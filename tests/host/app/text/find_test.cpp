// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/palette/search.hpp>
#include <host/app/presets/preset_list.hpp>
#include <host/app/text/find.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;

namespace
{
std::vector<std::string> titlesOf (const std::vector<Findable>& all, const std::string& query)
{
    std::vector<std::string> titles;
    for (const auto i : bestMatches (all, query))
        titles.push_back (all[i].title);
    return titles;
}

const std::vector<Preset>& presets()
{
    static const auto all = presetsIn (TACTUS_SOURCE_DIR "/graphs", catalogue());
    return all;
}

bool isAmong (const std::vector<Preset>& found, const std::string& name, std::size_t first)
{
    return std::ranges::find (found, name, &Preset::name) - found.begin() < static_cast<std::ptrdiff_t> (std::min (first, found.size()));
}
}   // namespace

TEST_CASE ("find: the title itself comes first, then words of the title, tags, their beginnings, synonyms and the text")
{
    const std::vector<Findable> all {
        { "In the text", "", "", "a pad that is viscous" },
        { "Sweets", "", "honey", "" },
        { "By its beginning", "", "viscousness", "" },
        { "By its tag", "", "viscous", "" },
        { "Not too viscous", "", "", "" },
        { "Viscous oil", "", "", "" },
        { "Viscous", "", "", "" },
        { "Elsewhere", "", "", "an inviscous pad" },
    };
    CHECK (titlesOf (all, "viscous")
           == std::vector<std::string> { "Viscous", "Not too viscous", "Viscous oil", "By its tag", "By its beginning", "Sweets", "In the text" });
    CHECK (titlesOf (all, " VISCOUS  oil") == std::vector<std::string> { "Viscous oil" });
    CHECK (titlesOf (all, "").size() == all.size());
}

TEST_CASE ("find: a port that is named whole comes before others that have its words")
{
    const std::vector<Findable> all { { "drag", "lfo.out -> drag.amplitude", "", "" }, { "lfo", "drag.out -> lfo.amplitude", "", "" } };
    CHECK (titlesOf (all, "lfo.amplitude") == std::vector<std::string> { "lfo", "drag" });
    CHECK (titlesOf (all, "drag.amplitude") == std::vector<std::string> { "drag", "lfo" });
}

TEST_CASE ("find: a word counts from its first letter, and a mistyped one only if nothing else fits")
{
    const std::vector<Findable> all { { "Sandpaper", "", "abrasive", "rough grains" }, { "Liver cut", "", "tissue", "it breaks through the skin" } };
    CHECK (titlesOf (all, "rough") == std::vector<std::string> { "Sandpaper" });
    CHECK (titlesOf (all, "sandpapr") == std::vector<std::string> { "Sandpaper" });
    CHECK (titlesOf (all, "xyzzy").empty());
}

TEST_CASE ("find: every preset and every node type is first under its own name")
{
    for (const auto& p : presets())
    {
        CAPTURE (p.name);
        CHECK (matching (presets(), p.name).front().name == p.name);
    }
    for (const auto& type : catalogue())
    {
        CAPTURE (type.info.name, type.info.id);
        CHECK (searchPalette (std::string (type.info.name), {}, catalogue(), {}).front().name == type.info.name);
        CHECK (searchPalette (std::string (type.info.id), {}, catalogue(), {}).front().type == type.info.id);
    }
}

TEST_CASE ("find: words that people type find what entries call otherwise, among presets and node types")
{
    CHECK (isAmong (matching (presets(), "squeak"), "Squealing rubber", 2));
    CHECK (isAmong (matching (presets(), "viscous"), "Honey", 1));
    for (const auto* word : { "squeak", "sticky", "bumpy", "buzz", "viscous", "subgraph" })
    {
        CAPTURE (word);
        CHECK_FALSE (matching (presets(), word).empty());
        graph::Graph g;
        g.graphs.emplace_back ("pad", graph::Patch {});
        CHECK_FALSE (searchPalette (word, g, catalogue(), {}).empty());
    }
    const std::pair<const char*, const char*> found[] {
        { "squishy", "Soft pad" },
        { "jelly", "Soft pad" },
        { "water", "Honey" },
        { "slippery", "Window pane" },
        { "detent", "Key switch" },
        { "click", "Tactile key" },
        { "pulse", "Heartbeat" },
        { "button", "Tactile key" },
        { "fabric", "Layered cloth" },
        { "rough", "Sandpaper" },
    };
    for (const auto& [word, name] : found)
    {
        CAPTURE (word);
        CHECK (isAmong (matching (presets(), word), name, 4));
    }
    for (const auto& p : matching (presets(), "rough"))
        CHECK (p.name != "Liver cut");   // "through"
}
