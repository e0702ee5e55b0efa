// SPDX-License-Identifier: MIT
// What every datasheet promises: names, units, ranges and sentences that people and files can rely on. every_node_test.cpp
// tests what the nodes do.

#include <tactus/node/catalogue.hpp>

#include "support/rig.hpp"

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
        if (const auto* v = std::get_if<double> (&f.initial)) CHECK (f.limits.hard.contains (*v));
        checkFields (f);
    }
}
}   // namespace

TEST_CASE ("every row of a datasheet has a name, a sentence and a default in range", "[nodes][contract]")
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
        const auto checkRange = [] (const Limits& limits, double v) {
            CHECK (limits.hard.min <= limits.hard.max);
            CHECK (limits.usual.min <= limits.usual.max);
            CHECK (limits.hard.contains (v));
            CHECK (limits.usual.contains (v));
        };

        for (const auto* ports : { &type.inputs, &type.params, &type.outputs })
            for (const auto& p : *ports)
            {
                INFO (type.info.id << "." << p.id);
                if (p.role == Role::output)
                    checkRow (p.id, p.about, out_names);
                else
                    checkRow (p.id, p.about, in_names);
                if (p.role != Role::param) continue;
                if (p.choices.empty())
                    for (int i = 0; i < p.width; ++i)
                        checkRange (p.limits, p.initial[i]);
                else
                    CHECK (p.initial[0] < static_cast<double> (p.choices.size()));
            }

        for (const auto& s : type.settings)
        {
            INFO (type.info.id << "." << s.id);
            checkRow (s.id, s.about, in_names);
            if (const auto* v = std::get_if<double> (&s.initial)) checkRange (s.limits, *v);

            checkFields (s);
        }
    }
}

TEST_CASE ("every choice has alternatives with different names", "[nodes][contract]")
{
    for (const auto& type : catalogue())
        for (const auto& p : type.params)
        {
            if (p.choices.empty()) continue;
            INFO (type.info.id << "." << p.id);
            CHECK (p.choices.size() > 1);
            CHECK (std::set<std::string_view> (p.choices.begin(), p.choices.end()).size() == p.choices.size());
            CHECK (std::ranges::none_of (p.choices, &std::string_view::empty));
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

TEST_CASE ("every node with a list has a setting for its length", "[nodes][contract]")
{
    for (const auto& type : catalogue())
    {
        INFO (type.info.id);
        const auto isList = [] (const PortSheet& p) { return p.list; };
        if (std::ranges::none_of (type.inputs, isList) && std::ranges::none_of (type.params, isList) && std::ranges::none_of (type.outputs, isList)) continue;

        const auto at = std::ranges::find (type.settings, std::string_view { "inputs" }, &SettingSheet::id);
        REQUIRE (at != type.settings.end());
        CHECK (at->kind == SettingSheet::Kind::integer);
        CHECK (at->limits.hard == Interval { 1, list_capacity });
    }
}

TEST_CASE ("no node has a problem with its defaults", "[nodes][contract]")
{
    for (const auto& type : catalogue())
    {
        INFO (type.info.id);
        CHECK (Rig { type }.problem() == "");
    }
}
