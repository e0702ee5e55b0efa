// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/model/node_doc.hpp>

#include <tactus/node/catalogue.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;

TEST_CASE ("every node of the catalogue has the doc comment of its header", "[app][doc]")
{
    for (const auto& type : catalogue())
    {
        INFO (type.info.id);
        const auto doc = docOf (type.info.id);
        REQUIRE_FALSE (doc.empty());
        CHECK (doc.front().kind == DocPart::Kind::text);
        for (const auto& part : doc)
        {
            CHECK_FALSE (part.text.empty());
            CHECK (part.text.find ("///") == std::string::npos);
        }
    }
    CHECK (docOf ("no.such").empty());
}

TEST_CASE ("the doc comment of a model contains its law", "[app][doc]")
{
    for (const auto* type : { "friction.elasto_plastic", "cut.blade", "deform.plane", "texture.grating", "vibration.modal", "shock.hunt_crossley" })
    {
        INFO (type);
        CHECK_FALSE (lawOf (type).empty());
    }
    const auto law = lawOf ("vibration.modal");
    CHECK (law.front().find ("value = gain sum_i") != std::string::npos);
}

TEST_CASE ("a doc comment is split into parts", "[app][doc]")
{
    const auto parts = readDoc ("First\nline.\n\n    f = -k x\n      + more\n\nGood to know\n - one\n   goes on\n - two\n\nLast.\n");
    using Kind = DocPart::Kind;
    const std::vector<std::pair<Kind, std::string>> expected {
        { Kind::text, "First line." },
        { Kind::formula, "f = -k x" },
        { Kind::formula, "  + more" },
        { Kind::heading, "Good to know" },
        { Kind::item, "one goes on" },
        { Kind::item, "two" },
        { Kind::text, "Last." },
    };
    REQUIRE (parts.size() == expected.size());
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
        CHECK (parts[i].kind == expected[i].first);
        CHECK (parts[i].text == expected[i].second);
    }
}
