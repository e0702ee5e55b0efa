// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/model/readable.hpp>

#include <catch2/catch.hpp>

#include <set>

using namespace tactus;
using namespace tactus::host;

TEST_CASE ("ids of datasheets become readable names", "[app][names]")
{
    CHECK (readable ("spatial_frequency") == "Spatial frequency");
    CHECK (readable ("force") == "Force");
    CHECK (readable ("d_max") == "d max");
    CHECK (readable ("x") == "x");
    CHECK (readable ("mu") == "μ");
    CHECK (readable ("gain_db") == "Gain dB");
    CHECK (readable ("in[2]") == "In[2]");
    CHECK (readable ("").empty());
    CHECK (nameWithId ("spatial_frequency") == "Spatial frequency (spatial_frequency)");
    CHECK (nameWithId ("force") == "Force");
    CHECK (nameWithId ("mu") == "μ (mu)");
}

TEST_CASE ("no two ports of a role of a node have the same readable name", "[app][names]")
{
    for (const auto& type : catalogue())
        for (const auto* ports : { &type.inputs, &type.params, &type.outputs })
        {
            std::set<std::string> names;
            for (const auto& p : *ports)
            {
                INFO (type.info.id << " " << p.id);
                CHECK (names.insert (readable (p.id)).second);
                CHECK (readable (p.id).find ('_') == std::string::npos);
            }
        }
}

TEST_CASE ("a port that a subgraph exposes keeps the name that the user gave it", "[app][names]")
{
    FacePort exposed { Role::input, "my_input", {}, UnitRule (UnitRule::Kind::open), 1, nullptr };
    CHECK (readableName (exposed) == "my_input");
    const auto* grating = catalogue().find ("texture.grating");
    REQUIRE (grating != nullptr);
    const auto sheet = std::ranges::find (grating->params, "spatial_frequency", &PortSheet::id);
    exposed.sheet = &*sheet;
    CHECK (readableName (exposed) == "my_input");
    exposed.id = "spatial_frequency";
    CHECK (readableName (exposed) == "Spatial frequency");
}
