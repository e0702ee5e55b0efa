// SPDX-License-Identifier: GPL-3.0-or-later
// How the scopes share their panel, on small and large screens.
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/seen_text.hpp"
#include "scope_bench.hpp"

#include <host/app/scopes/over_plot.hpp>
#include <host/app/scopes/scope_panel.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::Bench;
using tactus::host::test::DeskStage;
using tactus::host::test::OnStage;
using tactus::host::test::waitFor;

TEST_CASE ("scopes in a high panel are in a grid, all in view and none over another", "[app][scopes]")
{
    Bench b;
    for (const int scopes : { 2, 3, 4, 6, 8 })
        for (const int height : { 260, 600, 1000 })
        {
            INFO (scopes << " scopes, " << height);
            b.panel->setSize (1000, height);
            b.panel->showOwn();
            while (static_cast<int> (b.panel->shown().size()) < scopes)
                b.panel->add (ScopeKind::spectrum);
            std::set<int> rows;
            const auto& views = b.panel->shown();
            for (std::size_t i = 0; i < views.size(); ++i)
            {
                rows.insert (views[i]->getY());
                CHECK (views[i]->getWidth() >= 199);
                for (std::size_t j = 0; j < i; ++j)
                    CHECK_FALSE (views[i]->getBounds().intersects (views[j]->getBounds()));
            }
            if (height == 260) CHECK (rows.size() == 1);
            if (height == 1000 && scopes >= 4) CHECK (rows.size() >= 2);
        }
}

TEST_CASE ("what a plot shows of earlier passes has no colour of its legend", "[app][scopes]")
{
    for (const auto& theme : { Theme::dark(), Theme::light() })
    {
        const auto past = colourOfPast (theme);
        for (const auto other : { theme.of (Quantity::length), theme.of (Quantity::force), theme.dim, theme.canvas })
        {
            const auto apart =
                std::abs (past.getRed() - other.getRed()) + std::abs (past.getGreen() - other.getGreen()) + std::abs (past.getBlue() - other.getBlue());
            INFO (past.toDisplayString (false) << " and " << other.toDisplayString (false));
            CHECK (apart > 60);
            const auto hue = std::abs (past.getHue() - other.getHue());
            if (other != theme.dim && other != theme.canvas) CHECK (std::min (hue, 1.0f - hue) > 0.08f);
        }
    }
}

TEST_CASE ("the numbers of the axes are whole in a scope of any size", "[app][scopes]")
{
    Bench b;
    b.run (3000);
    for (const int width : { 620, 900, 1600 })
        for (const int height : { 200, 260, 420 })
        {
            b.panel->setSize (width, height);
            b.panel->refresh();
            for (const auto& v : b.panel->shown())
                for (const auto& t : tactus::host::test::readTexts (v->plot()))
                {
                    INFO (width << " x " << height << ": " << t.text);
                    const bool has_digit = t.text.containsAnyOf ("0123456789");
                    CHECK_FALSE ((has_digit && t.is_cut));
                }
        }
}

TEST_CASE ("a new spectrum shows the selected wire", "[app][scopes]")
{
    DeskStage w ("dry_wood.json", 1920, 600);
    auto& panel = w.show<ScopePanel> (scopesPanel);
    w.canvas.select ({ w.graph().root.wires.front().id });
    w.click ("+ Spectrum");
    const auto* made = panel.scopes().scopes.back().get();
    CHECK (made->kind == ScopeKind::spectrum);
    CHECK (made->ports == std::vector<std::string> { "hand.position" });
    w.canvas.select ({});
    w.click ("+ Spectrum");
    CHECK (panel.scopes().scopes.back()->ports == std::vector<std::string> { "motor.applied" });
}

TEST_CASE ("two fingers open without a word about scopes that do not fit", "[app][scopes]")
{
    DeskStage w ("two_fingers.json");
    auto& panel = w.show<ScopePanel> (scopesPanel);
    auto& run = w.playback.run();
    run.start ({});
    REQUIRE (waitFor ([&] { return run.isRunning() && ! run.traces().of ("finger/motor.applied").empty(); }));
    OnStage::settle (100);
    CHECK (panel.warning().isEmpty());
    CHECK (run.traces().of ("finger[0]/skin.state").size() == 1);
}

TEST_CASE ("scopes: where an image or the data of a scope is saved is asked", "[app][scopes]")
{
    DeskStage w ("dry_wood.json", 1600, 900);
    auto& panel = w.show<ScopePanel> (scopesPanel);
    auto& view = panel.add (ScopeKind::energy);
    REQUIRE (w.start());
    REQUIRE (waitFor ([&] { return static_cast<bool> (view.saveData (w.home / "trial.csv")); }));   // there is something to save
    const auto [steps, ending] = GENERATE (std::pair (1, ".png"), std::pair (2, ".csv"));
    std::filesystem::path asked;
    w.desk.chooseFile = [&] (bool saves, const std::filesystem::path& begin, const auto& chosen) {
        CHECK (saves);
        asked = begin;
        chosen (w.home / ("mine" + begin.extension().string()));
    };
    w.choose (w.middleOf (*w.titled ("Save as image or data")), steps, juce::ModifierKeys::leftButtonModifier);
    CHECK (asked.extension() == ending);
    CHECK (std::filesystem::exists (w.home / (std::string ("mine") + ending)));
}
