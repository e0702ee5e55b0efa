// SPDX-License-Identifier: GPL-3.0-or-later
// Undo takes back what was done to the scopes too, and never touches the graph for it. The history says what was done.
#include "host/app/support/desk_stage.hpp"

#include <host/app/scopes/scope_panel.hpp>

#include <tactus/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::latestStep;
using tactus::host::test::OnStage;

namespace
{
std::vector<juce::Rectangle<int>> scopes (DeskStage& w)
{
    std::vector<juce::Rectangle<int>> all;
    auto* panel = dynamic_cast<ScopePanel*> (w.titled ("Scopes"));
    REQUIRE (panel != nullptr);
    for (const auto& v : panel->shown())
        all.push_back (v->getBounds());
    return all;
}

void undoAndRedo (DeskStage& w, const std::function<bool()>& isDone)
{
    const auto text = writeGraph (w.graph());
    const bool was_changed = w.document.isChanged();
    REQUIRE (isDone());
    for (int i = 0; i < 2; ++i)
    {
        w.key ("ctrl + z");
        CHECK_FALSE (isDone());
        CHECK (writeGraph (w.graph()) == text);
        w.key ("ctrl + y");
        CHECK (isDone());
        CHECK (writeGraph (w.graph()) == text);
    }
    CHECK (w.document.isChanged() == was_changed);
}
}   // namespace

TEST_CASE ("closing, moving and sizing scopes are steps that can be undone", "[app][undo]")
{
    DeskStage w ("dry_wood.json", 1600, 900);
    auto& panel = w.show<ScopePanel> (scopesPanel);
    const auto settled = [&] { OnStage::settle (60); };
    const auto before = scopes (w);
    REQUIRE (before.size() >= 2);

    auto* edge = OnStage::titledIn (panel, "Edge between scopes");
    REQUIRE (edge != nullptr);
    w.stage->drag (w.middleOf (*edge), w.middleOf (*edge).translated (60.0f, 0.0f));
    settled();
    undoAndRedo (w, [&] { return std::abs (scopes (w)[0].getWidth() - before[0].getWidth() - 60) <= 2; });
    CHECK (latestStep (w.document) == "size scopes");

    const auto first = panel.shown()[0]->shown().kind;
    const auto title = w.stage->getLocalPoint (panel.shown()[0].get(), juce::Point<float> (20.0f, 12.0f));
    w.stage->drag (title, w.middleOf (*panel.shown()[1]));
    settled();
    undoAndRedo (w, [&] { return panel.shown()[1]->shown().kind == first; });

    auto* cross = OnStage::titledIn (*panel.shown()[0], "Close this scope");
    REQUIRE (cross != nullptr);
    w.stage->click (w.middleOf (*cross));
    settled();
    undoAndRedo (w, [&] { return scopes (w).size() == before.size() - 1; });
    CHECK (latestStep (w.document) == "close scope");
}

TEST_CASE ("P on several nodes is one step, which one undo takes back", "[app][undo]")
{
    DeskStage w ("dry_wood.json", 1600, 900);
    auto& panel = w.show<ScopePanel> (scopesPanel);
    w.canvas.select ({ w.graph().root.find ("drag")->id, w.graph().root.find ("grain")->id });
    const auto ports = w.canvas.commands().selectedPorts();
    REQUIRE (ports.size() == 2);
    const auto probed = [&] { return std::pair { panel.isProbed (ports[0]), panel.isProbed (ports[1]) }; };
    const auto before = probed();
    const auto steps = w.document.history().size();
    w.canvas.grabKeyboardFocus();
    w.key ("p");
    CHECK (probed() == std::pair { ! before.first, ! before.second });
    CHECK (w.document.history().size() == steps + 1);
    CHECK (latestStep (w.document) == "probe");
    w.key ("ctrl + z");
    CHECK (probed() == before);
}
