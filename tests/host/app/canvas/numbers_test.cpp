// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers on a node.
#include "host/app/support/canvas_rig.hpp"

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

TEST_CASE ("a node shows six digits of a long number, and an edit of it that changes nothing keeps them all", "[app][canvas]")
{
    const auto [written, shown] = GENERATE (std::pair { Json ("569.343065693 mN"), "569.343 mN" }, std::pair { Json (0.123456789), "123.457 mN" },
                                            std::pair { Json ("0.30 N"), "0.30 N" }, std::pair { Json ("100 mN"), "100 mN" });
    CAPTURE (shown);
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    auto g = rig.graph();
    g.controls.clear();
    std::ranges::find (g.root.nodes, "grain", &graph::Node::name)->params["amplitude"] = written;
    rig.document.open (std::move (g), {}, "open");
    rig.canvas->frameStart();
    const auto value = rig.node ("grain").box.find (Role::param, "amplitude")->value;
    CHECK (value == shown);

    rig.hand().doubleClick (rig.value ("grain", "amplitude"));
    auto* editor = dynamic_cast<juce::TextEditor*> (rig.canvas->getChildComponent (0));
    REQUIRE (editor != nullptr);
    CHECK (editor->getText() == juce::String (value));
    const auto position = rig.document.history().position();
    editor->onReturnKey();
    CHECK (rig.graph().root.find ("grain")->params["amplitude"] == written);
    CHECK (rig.document.history().position() == position);
}
