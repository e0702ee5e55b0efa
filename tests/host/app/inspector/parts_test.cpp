// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/inspector/settings/file_text.hpp>
#include <host/app/inspector/settings/law_shape.hpp>
#include <host/app/model/controlled_param.hpp>
#include <host/app/model/param_value.hpp>
#include <host/assets/file_assets.hpp>
#include <tactus/graph/history.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

using namespace tactus;
using namespace tactus::host;

TEST_CASE ("a file is described, or its problem reported", "[inspector]")
{
    FileAssets assets;
    const std::string folder = TACTUS_SOURCE_DIR "/graphs";
    const auto mesh = describeFile ("assets/liver.obj", SettingSheet::Kind::surface, folder, assets);
    CHECK_FALSE (mesh.is_problem);
    CHECK (mesh.text.find ("vertices") != std::string::npos);
    const auto image = describeFile ("assets/leather.png", SettingSheet::Kind::image, folder, assets);
    CHECK (image.picture != nullptr);
    CHECK (image.text.find ("pixels") != std::string::npos);
    CHECK (describeFile ("assets/heartbeat.haptic", SettingSheet::Kind::table, folder, assets).text.find (" s long, 1 track") != std::string::npos);
    CHECK (describeFile ("assets/none.png", SettingSheet::Kind::image, folder, assets).is_problem);
    CHECK (describeFile ("assets/leather.py", SettingSheet::Kind::signal, folder, assets).is_problem);
    CHECK_FALSE (describeFile ("", SettingSheet::Kind::image, folder, assets).is_problem);
}

TEST_CASE ("a chosen file is stored relative to the graph", "[inspector]")
{
    const std::string folder = TACTUS_SOURCE_DIR "/graphs";
    CHECK (pathFrom (folder + "/assets/liver.obj", folder) == "assets/liver.obj");
    CHECK (pathFrom (TACTUS_SOURCE_DIR "/nodes/x.wav", folder) == "../nodes/x.wav");
    CHECK (pathFrom ("/somewhere/x.wav", "") == "/somewhere/x.wav");
}

TEST_CASE ("moving a control for a parameter sets its value, but only within the range", "[inspector]")
{
    CHECK (rc::check ([] {
        const double low = *rc::gen::inRange (-100, 100) * 0.1;
        const auto other = rc::gen::suchThat (rc::gen::inRange (-100, 100), [low] (int v) { return v * 0.1 != low; });
        const double high = *other * 0.1;
        graph::Graph g;
        graph::Node a;
        a.name = "a";
        g.root.nodes.push_back (a);
        graph::Control c;
        c.id = c.name = "c";
        c.to.push_back ({ "a.x", low, high });
        g.controls.push_back (c);
        graph::History history (std::move (g));
        const auto param = controlOf (history.graph(), "a.x");
        RC_ASSERT (param.has_value());
        const double wanted = low + (high - low) * *rc::gen::inRange (0, 1001) * 1e-3;
        const auto command = moveControlFor (history.graph(), *param, wanted);
        RC_ASSERT (command.has_value());
        RC_ASSERT (history.perform (*command).has_value());
        RC_ASSERT (std::abs (controlOf (history.graph(), "a.x")->value - wanted) < 1e-5 * std::abs (high - low));
        RC_ASSERT (! moveControlFor (history.graph(), *param, high + 0.1 * (high - low)));
    }));
}

TEST_CASE ("a law can be converted to any kind and agrees at 1 N", "[inspector]")
{
    Law spring;
    spring.kind = Law::Kind::power;
    spring.a = 2000.0;
    for (const auto& kind : lawKinds())
    {
        const auto law = lawOfKind (kind, spring);
        CHECK (lawKindOf (law) == kind);
        if (kind == "power") CHECK (law["power"][0].get<double>() == Approx (2000.0).epsilon (0.01));
        if (kind == "exponential")
        {
            const auto a = law["exponential"][0].get<double>(), b = law["exponential"][1].get<double>();
            CHECK (a * std::expm1 (b * 0.5e-3) == Approx (1.0).epsilon (0.02));
        }
        if (kind == "table") CHECK (law["table"][1][2].get<double>() == Approx (1.0).epsilon (0.01));
    }
}

TEST_CASE ("a control gets the usual range of a parameter, in the unit it is written in", "[inspector]")
{
    PortSheet sheet { Role::param, "x", unit::metre, "", { .hard = { 0, inf }, .usual = { 1e-5, 1e-3 } }, {}, 1, false, 0, { 1e-4, 0, 0 } };
    const auto [low, high] = sweepOf (Json ("0.4 mm"), sheet);
    CHECK (low == "0.01 mm");
    CHECK (high == "1 mm");
    sheet.limits.usual = { 0, inf };
    CHECK (sweepOf (Json (0.2), sheet).second == 0.4);
}
