// SPDX-License-Identifier: GPL-3.0-or-later
// What happens to a fit when it meets unsaved changes, in the whole window.
#include "host/app/support/window_rig.hpp"

#include <host/app/fit_panel/fit_panel.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

TEST_CASE ("fit panel: Cancel at the question about unsaved changes keeps the fit", "[app][fit]")
{
    WindowRig w ("dry_wood.json");
    REQUIRE (w.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
    const auto* before = w.view->document().identity();
    const auto file = w.home / "strokes.csv";
    {
        std::ofstream out (file);
        out << "Time,Velocity,Normal,Friction\n";
        double d = 0.0;
        for (int i = 0; i < 1200; ++i)
        {
            const double v = i % 400 < 200 ? 5e-3 : -5e-3;
            d = std::clamp (d + 1e-3 * v, -1e-4, 1e-4);
            out << 1e-3 * i << ',' << v << ",2," << -0.8 * d / 1e-4 + 0.002 * std::sin (7.0 * i) << '\n';
        }
    }
    auto& panel = w.view->part<FitPanel>();
    w.view->desk().fitRecording (file);
    for (int i = 0; i < 4000 && panel.isFitting(); ++i)
        WindowRig::settle (5);
    REQUIRE (panel.fitted());
    w.click ("Open as new graph");
    REQUIRE (w.view->asked().isOpen());
    w.key ("escape");
    CHECK_FALSE (w.view->asked().isOpen());
    CHECK (panel.isOpen());
    CHECK (panel.fitted());
    CHECK (w.view->document().identity() == before);

    w.click ("Open as new graph");
    w.click ("Don't save");
    CHECK_FALSE (panel.isOpen());
    CHECK (w.view->document().identity() != before);
    CHECK (w.graph().root.find ("drag")->params.at ("mu").get<double>() == Approx (0.4).epsilon (0.05));

    // The fit has no file yet, so nothing throws it away without a question.
    const auto* fitted = w.view->document().identity();
    bool is_closed = false;
    const std::vector<std::function<void()>> acts { [&] { w.key ("ctrl + n"); },
                                                    [&] { w.view->open (TACTUS_SOURCE_DIR "/graphs/soft_pad.json"); },
                                                    [&] { w.view->closeWhenSaved ([&] { is_closed = true; }); } };
    for (const auto& act : acts)
    {
        act();
        REQUIRE (w.view->asked().isOpen());
        w.key ("escape");
        CHECK (w.view->document().identity() == fitted);
    }
    CHECK_FALSE (is_closed);
}
