// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/desk_stage.hpp"

#include <host/app/problems/problem_list.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::OnStage;
using tactus::host::test::waitFor;

TEST_CASE ("a slow click on a problem shows its node", "[app][mouse][problems]")
{
    DeskStage w ("dry_wood.json");
    auto& list = w.show<ProblemList> (problemsPanel);
    REQUIRE (w.document.perform (graph::SetParam { {}, "drag", "mu", Json ("many") }));
    REQUIRE (waitFor ([&] { return list.messages().size() == 1; }));
    w.canvas.select ({});
    w.stage->move (w.stage->getLocalPoint (&list, juce::Point<float> (60.0f, 24.0f)));
    w.stage->press();
    w.stage->hold();
    w.stage->release();
    OnStage::settle();
    CHECK (w.canvas.selection() == Selection { w.graph().root.find ("drag")->id });
}
