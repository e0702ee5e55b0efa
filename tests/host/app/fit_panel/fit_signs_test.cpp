// SPDX-License-Identifier: GPL-3.0-or-later
// The signs of the columns of a recording.
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/fit_panel/fit_panel.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/run/views/safety_strip.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::OnStage;
using tactus::host::test::waitFor;

namespace
{
/// The panel as it covers the window, below its strip.
struct FitStage : DeskStage
{
    explicit FitStage (int width = 1280, int height = 720) : DeskStage ("dry_wood.json", width, height)
    {
        show<FitPanel> (fitPanel).setBounds (stage->getLocalBounds().withTrimmedTop (SafetyStrip::height));
    }
    FitPanel& panel() { return dynamic_cast<FitPanel&> (*DeskRig::panel->component); }
};

/// Waits for the fit of the panel, which must come about or not.
void finishFit (FitStage& w, bool is_possible)
{
    auto& panel = w.panel();
    REQUIRE (waitFor ([&] { return ! panel.isFitting(); }, 5));
    INFO (panel.problem());
    REQUIRE (panel.fitted().has_value() == is_possible);
}

/// A tool that presses from a height of 30 mm down to 22 mm.
std::filesystem::path writeHeights (FitStage& w)
{
    const auto file = w.home / "press.csv";
    std::ofstream out (file);
    out << "z_mm,force_N\n";
    for (int i = 0; i <= 400; ++i)
        out << 30.0 - 0.02 * i << ',' << 4e-3 * i + 1e-5 * i * i << '\n';
    return file;
}

bool isSaid (FitStage& w, const char* text)
{
    const auto texts = tactus::host::test::readTexts (w.panel());
    return std::ranges::any_of (texts, [&] (const auto& t) { return t.text.contains (text); });
}

bool isTurned (FitStage& w, const char* title)
{
    const auto* sign = dynamic_cast<juce::Button*> (w.titled (title));
    REQUIRE (sign != nullptr);
    return sign->getToggleState();
}
}   // namespace

TEST_CASE ("fit panel: a height that falls as the tool presses is a press, and each sign can be turned by a click", "[app][fit]")
{
    FitStage w;
    auto& panel = w.panel();
    w.desk.fitRecording (writeHeights (w));
    CHECK (panel.kind() == FitKind::curve);
    finishFit (w, true);
    CHECK (panel.fitted()->report.is_good);
    CHECK (panel.fitted()->report.picture.curves.front().x.back() == Approx (8e-3).epsilon (0.02));
    CHECK (isSaid (w, "its sign was turned"));
    CHECK (isSaid (w, "counted from 30 mm"));
    CHECK (isTurned (w, "Sign of depth"));
    CHECK_FALSE (isTurned (w, "Sign of force"));

    w.clickTitled ("Sign of depth");   // as recorded, the tool goes out while the force grows
    finishFit (w, false);
    CHECK (panel.problem().contains ("You have chosen the sign of depth"));   // the click is what has made it fail
    CHECK_FALSE (isTurned (w, "Sign of depth"));
    w.clickTitled ("Sign of depth");
    finishFit (w, true);
    w.clickTitled ("Sign of force");
    CHECK (isTurned (w, "Sign of force"));
    finishFit (w, false);
    w.clickTitled ("Sign of force");
    finishFit (w, true);

    panel.choose (FitKind::grating);   // its height has a meaning with either sign, and the field of the unit takes it
    CHECK (w.titled ("Sign of height") == nullptr);
    panel.choose (FitKind::curve);   // begins with what the recording says
    CHECK (isTurned (w, "Sign of depth"));
    finishFit (w, true);
}

TEST_CASE ("fit panel: a minus in a unit turns the sign, and the button shows it", "[app][fit]")
{
    FitStage w;
    auto& panel = w.panel();
    w.desk.fitRecording (writeHeights (w));
    finishFit (w, true);
    panel.columns().turn ("depth");
    finishFit (w, false);
    auto* unit = dynamic_cast<juce::TextEditor*> (w.titled ("Unit of depth"));
    REQUIRE (unit != nullptr);
    unit->grabKeyboardFocus();
    unit->setText ("-1 mm", false);
    w.key ("return");
    CHECK (unit->getText() == "1 mm");
    CHECK (isTurned (w, "Sign of depth"));
    finishFit (w, true);
    CHECK (panel.fitted()->report.picture.curves.front().x.back() == Approx (8e-3).epsilon (0.02));
    unit->giveAwayKeyboardFocus();
    OnStage::settle();
    CHECK (isTurned (w, "Sign of depth"));
    panel.columns().chooseColumn ("depth", "force_N");   // another column begins with its own sign
    CHECK (panel.columns().choice().turned.empty());
}

TEST_CASE ("fit panel: at 1024 by 700 and 200 %, the table and the legend are whole", "[app][fit][small]")
{
    const auto [width, height] = GENERATE (std::pair (512, 350), std::pair (640, 360), std::pair (1280, 720));
    INFO (width << " x " << height);
    FitStage w (width, height);
    w.desk.fitRecording (writeHeights (w));
    finishFit (w, true);
    OnStage::settle (50);
    auto& panel = w.panel();
    const auto texts = tactus::host::test::readTexts (panel);
    const auto area = panel.getLocalBounds().toFloat();
    CHECK (tactus::host::test::overlaps (texts, area).joinIntoString ("; ") == "");
    for (const auto& t : texts)
    {
        INFO (t.text);
        const bool may_be_short = t.text.startsWith ("Fit ") || t.text.startsWith ("Force-displacement") || t.text.contains (fromUtf8 (" \xe2\x80\x93 "));
        CHECK ((may_be_short || ! (t.text.endsWith ("...") || t.text.endsWith (fromUtf8 ("\xe2\x80\xa6")))));
    }
}
