// SPDX-License-Identifier: GPL-3.0-or-later
// What plugins say about the looks of their nodes.
#include <nodes/deform/plane.hpp>
#include <tactus/plugin/known.hpp>
#include <tactus/plugin/node_plugin.hpp>
#include <tactus/plugin/plugin_node.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

namespace
{
using Plane = plugin::Hooks<nodes::Plane>;

/// deform.plane as a plugin would describe it.
struct Guest
{
    plugin::Described described { Plane::type() };
    tactus_plugin_appearance looks {};

    Guest()
    {
        Plane::fill (described.node);
        REQUIRE (described.node.appearance != nullptr);
        looks = *described.node.appearance;
        described.node.appearance = &looks;
    }

    Result<NodeType> read() { return plugin::readNode (&described.node, "guest.tactus", nullptr, 0, {}); }
};
}   // namespace

TEST_CASE ("the host reads the appearance of a plugin's node as the node declares it", "[app][scene][plugins]")
{
    Guest guest;
    const auto type = guest.read();
    REQUIRE (type);
    REQUIRE (type->appearance);
    CHECK (type->appearance->kind == Appearance::Kind::plane);
    for (const auto& part : appearance_parts)
        CHECK ((*type->appearance).*part.row == nodes::Plane::appearance.*part.row);
}

TEST_CASE ("a plugin from before appearances still loads, without one", "[app][scene][plugins]")
{
    Guest guest;
    guest.described.node.size = static_cast<std::uint32_t> (plugin::first_size<tactus_plugin_node>);
    const auto type = guest.read();
    REQUIRE (type);
    CHECK_FALSE (type->appearance);
}

TEST_CASE ("a kind or a part that the host does not know is left out", "[app][scene][plugins]")
{
    Guest guest;
    guest.looks.kind = "cloud";
    auto type = guest.read();
    REQUIRE (type);
    CHECK_FALSE (type->appearance);

    guest.looks.kind = "plane";
    std::vector<const char*> parts (guest.looks.parts, guest.looks.parts + guest.looks.part_count);
    const std::string first = parts[0];
    parts[0] = "fur";
    guest.looks.parts = parts.data();
    type = guest.read();
    REQUIRE (type);
    REQUIRE (type->appearance);
    CHECK (first == "tool");
    CHECK (type->appearance->tool.empty());
    CHECK (type->appearance->offset == "offset");
}

TEST_CASE ("an appearance that names a row that does not exist is refused, and the row is named", "[app][scene][plugins]")
{
    Guest guest;
    std::vector<const char*> rows (guest.looks.rows, guest.looks.rows + guest.looks.part_count);
    rows[0] = "nowhere";
    guest.looks.rows = rows.data();
    const auto type = guest.read();
    REQUIRE_FALSE (type);
    CHECK (type.error().id == "plugin/bad_node");
    CHECK (type.error().text.find ("'nowhere'") != std::string::npos);
    guest.looks.size = 4;
    CHECK_FALSE (guest.read());
}
