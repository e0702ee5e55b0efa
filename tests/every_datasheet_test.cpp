// SPDX-License-Identifier: MIT
// What every datasheet promises: names, units, ranges and sentences that people and files can rely on. every_node_test.cpp
// tests what the nodes do, and what a plugin's datasheet must promise too.

#include <tactus/node/catalogue.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

using namespace tactus;

namespace
{
/// [a-z][a-z0-9_]*
bool isName (std::string_view s)
{
    const auto isLetter = [] (char c) { return c >= 'a' && c <= 'z'; };
    return ! s.empty() && isLetter (s.front()) && std::ranges::all_of (s, [&] (char c) { return isLetter (c) || (c >= '0' && c <= '9') || c == '_'; });
}
}   // namespace

TEST_CASE ("every node has a unique id, family.name, that matches its header", "[nodes][contract]")
{
    std::set<std::string> ids;

    for (const auto& type : catalogue())
    {
        const std::string id { type.info.id };
        INFO (id);
        CHECK (ids.insert (id).second);
        const auto dot = id.find ('.');
        REQUIRE (dot != std::string::npos);
        CHECK (isName (id.substr (0, dot)));
        CHECK (isName (id.substr (dot + 1)));
        CHECK (std::filesystem::exists (std::filesystem::path { TACTUS_SOURCE_DIR } / "nodes" / id.substr (0, dot) / (id.substr (dot + 1) + ".hpp")));
        CHECK (catalogue().find (id) == &type);
    }
}

TEST_CASE ("every node has a name, a summary and a source", "[nodes][contract]")
{
    for (const auto& type : catalogue())
    {
        INFO (type.info.id);
        CHECK_FALSE (type.info.name.empty());
        CHECK_FALSE (type.info.source.empty());
        CHECK (type.info.summary.ends_with ('.'));
    }
}

namespace
{
void checkFields (const SettingSheet& s)
{
    std::set<std::string_view> names;
    for (const auto& f : s.fields)
    {
        INFO (f.id);
        CHECK (names.insert (f.id).second);
        CHECK (isName (std::string (f.id)));
        CHECK_FALSE (f.about.empty());
        checkFields (f);
    }
}
}   // namespace

TEST_CASE ("every row of a datasheet has a name and a sentence", "[nodes][contract]")
{
    for (const auto& type : catalogue())
    {
        std::set<std::string> in_names, out_names;
        const auto checkRow = [&] (std::string_view id, std::string_view about, auto& names) {
            const std::string name { id };
            CHECK (names.insert (name).second);
            CHECK (isName (name));
            CHECK_FALSE (about.empty());
        };
        for (const auto* ports : { &type.inputs, &type.params, &type.outputs })
            for (const auto& p : *ports)
            {
                INFO (type.info.id << "." << p.id);
                if (p.role == Role::output)
                    checkRow (p.id, p.about, out_names);
                else
                    checkRow (p.id, p.about, in_names);
            }

        for (const auto& s : type.settings)
        {
            INFO (type.info.id << "." << s.id);
            checkRow (s.id, s.about, in_names);
            checkFields (s);
        }
    }
}

TEST_CASE ("every unit that depends on another port names one that exists", "[nodes][contract]")
{
    for (const auto& type : catalogue())
    {
        std::set<std::string_view> names;
        for (const auto* ports : { &type.inputs, &type.params, &type.outputs })
            for (const auto& p : *ports)
                names.insert (p.id);

        const auto checkUnit = [&] (const UnitRule& unit) {
            if (unit.kind != UnitRule::Kind::same && unit.kind != UnitRule::Kind::product) return;
            CHECK (names.contains (unit.a));
            if (! unit.b.empty()) CHECK (names.contains (unit.b));
        };
        for (const auto* ports : { &type.inputs, &type.params, &type.outputs })
            for (const auto& p : *ports)
            {
                INFO (type.info.id << "." << p.id);
                checkUnit (p.unit);
            }
        for (const auto& s : type.settings)
        {
            INFO (type.info.id << "." << s.id);
            checkUnit (s.unit);
            checkUnit (s.x_unit);
        }
    }
}
