// SPDX-License-Identifier: GPL-3.0-or-later
#include <support/property.hpp>

#include <host/app/scopes/scope_model.hpp>
#include <host/app/scopes/scope_plot.hpp>

#include <cmath>
#include <limits>

using namespace tactus::host;

TEST_CASE ("scopes: a probe adds a trace to the first oscilloscope, and a second one removes it", "[app][scopes]")
{
    ScopeModel model;
    CHECK (model.probe ("drag.force"));   // adds a scope
    REQUIRE (model.scopes.size() == 1);
    CHECK (model.probe ("board.depth"));
    CHECK (model.shows ("drag.force"));
    CHECK_FALSE (model.probe ("drag.force"));
    CHECK_FALSE (model.shows ("drag.force"));
    CHECK (model.scopes.front()->ports == std::vector<std::string> { "board.depth" });
}

TEST_CASE ("scopes: a probe goes to the active scope if it shows traces", "[app][scopes]")
{
    ScopeModel model;
    for (const auto kind : { ScopeKind::time, ScopeKind::over, ScopeKind::spectrum })
    {
        model.scopes.push_back (std::make_unique<ScopeSpec>());
        model.scopes.back()->kind = kind;
    }
    model.active = model.scopes[2].get();
    model.probe ("a.x");
    CHECK (model.scopes[2]->ports == std::vector<std::string> { "a.x" });
    model.active = model.scopes[1].get();
    model.probe ("b.x");
    CHECK (model.scopes[0]->ports == std::vector<std::string> { "b.x" });
}

TEST_CASE ("scopes: the first click gives one cursor, the second two, the third none, and both cursors are in one lane", "[app][scopes]")
{
    std::vector<Cursor> cursors;
    click (cursors, { 0, 1.0, 2.0 });
    click (cursors, { 0, 3.0, 5.0 });
    REQUIRE (cursors.size() == 2);
    CHECK (cursors[1].x - cursors[0].x == 2.0);
    click (cursors, { 0, 1.0, 1.0 });
    CHECK (cursors.empty());
    click (cursors, { 0, 1.0, 1.0 });
    click (cursors, { 1, 2.0, 1.0 });
    REQUIRE (cursors.size() == 1);
    CHECK (cursors.front().lane == 1);
}

TEST_CASE ("scopes: an automatic range always contains the signal", "[app][scopes]")
{
    tactus::test::property ("any values", [] (const std::vector<std::pair<short, unsigned char>>& all) {
        AutoRange range (3);
        for (const auto& [low, size] : all)
        {
            const Extent seen { low / 10.0, low / 10.0 + size / 10.0 };
            const auto shown = range.update (seen);
            RC_ASSERT (shown.low <= seen.low);
            RC_ASSERT (shown.high >= seen.high);
            RC_ASSERT (shown.size() > 0.0);
        }
    });
}

TEST_CASE ("scopes: an automatic range adapts immediately when a resting signal moves", "[app][scopes]")
{
    AutoRange range;
    CHECK (range.update ({ 0.0, 0.0 }).high == 1.0);
    CHECK (range.update ({ 0.0, 0.01 }).high < 0.02);
}

TEST_CASE ("scopes: an automatic range does not follow every stroke, and narrows after the signal has been small for a while", "[app][scopes]")
{
    AutoRange range (10);
    const auto wide = range.update ({ -1.0, 1.0 });
    for (int i = 0; i < 100; ++i)
    {
        const double a = i % 8 == 0 ? 1.0 : 0.1;
        const auto now = range.update ({ -a, a });
        CHECK (now.low == wide.low);
        CHECK (now.high == wide.high);
    }
    for (int i = 0; i < 12; ++i)
        range.update ({ -0.1, 0.1 });
    CHECK (range.shown().high < 0.2);
    CHECK (range.shown().high > 0.1);

    // A slightly smaller signal does not narrow the range.
    const auto narrow = range.shown();
    for (int i = 0; i < 100; ++i)
        range.update ({ -0.08, 0.08 });
    CHECK (range.shown().high == narrow.high);
}

TEST_CASE ("scopes: a spectrogram shows one port, and a probe replaces it", "[app][scopes][spectrogram]")
{
    ScopeModel model;
    model.scopes.push_back (std::make_unique<ScopeSpec>());
    model.scopes.back()->kind = ScopeKind::spectrogram;
    model.active = model.scopes.back().get();
    CHECK (model.probe ("a.x"));
    CHECK (model.probe ("b.x"));
    REQUIRE (model.scopes.size() == 1);
    CHECK (model.scopes[0]->ports == std::vector<std::string> { "b.x" });
    CHECK (portsOf (*model.scopes[0], {}) == std::vector<std::string> { "b.x" });
    CHECK_FALSE (model.probe ("b.x"));
    CHECK (model.scopes[0]->ports.empty());
}

TEST_CASE ("scopes: every value has a finite place in a lane, also in one that is empty or zoomed", "[app][scopes]")
{
    for (const Extent range : { Extent {}, Extent { 0.0, 0.0 }, Extent { 0.0, 1e-14 }, Extent { -1e299, 1e299 }, Extent { 1.0, 2.0 } })
        for (const bool is_logarithmic : { false, true })
        {
            const Lane lane { .area = { 10.0f, 10.0f, 100.0f, 50.0f }, .x = range, .y = range, .unit = {}, .x_unit = {}, .is_logarithmic = is_logarithmic };
            for (const double v : { 0.0, 1.5, -1e300, 1e300, std::numeric_limits<double>::infinity(), std::nan ("") })
                CHECK (lane.toPixels (v, v).isFinite());
        }
}
