// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "desk_rig.hpp"
#include "on_stage.hpp"

#include <host/app/adding/add_graph.hpp>
#include <host/app/adding/node_palette.hpp>
#include <host/app/compose/banks.hpp>
#include <host/app/compose/removal.hpp>
#include <host/app/inspector/inspector.hpp>
#include <host/app/run/views/hand_panel.hpp>
#include <host/app/run/views/live_feed.hpp>
#include <host/app/window/status_line.hpp>

namespace tactus::host::test
{

/// A desk on a screen, with a mouse and a keyboard: the canvas, the inspector at its right, the status line, and, if a test asks for them, a panel and the
/// hand below. What the window alone does is not there: files, menus, the palette and most of its keys.
struct DeskStage : OnStage, DeskRig, private juce::Timer
{
    Inspector inspector { document, catalogue() };
    LiveFeed live { canvas, playback.run() };
    StatusLine status;
    std::unique_ptr<HandPanel> hand;
    int panel_height = 264;

    /// A file of graphs/, or one with an absolute path.
    explicit DeskStage (const std::string& preset = {}, int width = 1280, int height = 720) : DeskStage (load (preset), width, height) {}

    explicit DeskStage (graph::Graph g, int width = 1280, int height = 720) : DeskRig (std::move (g))
    {
        stage = std::make_unique<Stage> (width, height);
        stage->onKey = [this] (const juce::KeyPress& k) { return canvas.keyPressed (k); };
        for (juce::Component* part : std::initializer_list<juce::Component*> { &canvas, &inspector, &status })
            stage->addAndMakeVisible (*part);
        stage->addChildComponent (question);
        live.limits = &limits;
        connect();
        layOut();
        canvas.frameStart();
        canvas.onSelection();
        canvas.grabKeyboardFocus();
        startTimerHz (30);
        settle();
    }

    ~DeskStage() override
    {
        stopTimer();
        playback.run().letGo();
        hand.reset();
        panel.reset();
        canvas.onSelection = {};
        stage.reset();
    }

    /// Makes a panel and shows it.
    template <typename Component>
    Component& show (Panel (*maker) (Desk&), int height = 264)
    {
        auto& made = make<Component> (maker);
        panel_height = height;
        stage->addChildComponent (made);
        made.setVisible (true);   // now that it is on the screen, as some panels want to know
        for (const auto& begin : { panel->reload, panel->restore })
            if (begin) begin();
        layOut();
        settle();
        return made;
    }

    HandPanel& showHand()
    {
        hand = std::make_unique<HandPanel> (playback, sound);
        hand->onHint = desk.hint;
        hand->scene().reachesNow = [this] { return desk.reaches(); };
        hand->scene().onMoveOrigin = [this] (const std::string& role, const Vec3& origin) { desk.moveOrigin (role, origin); };
        desk.useDevice = [this] { return hand->useDevice(); };
        stage->addAndMakeVisible (*hand);
        layOut();
        settle();
        return *hand;
    }

    void layOut()
    {
        auto area = stage->getLocalBounds();
        question.setBounds (area);
        question.toFront (false);
        status.setBounds (area.removeFromBottom (StatusLine::height));
        if (panel || hand)
        {
            auto below = area.removeFromBottom (panel_height);
            if (hand) hand->setBounds (panel ? below.removeFromRight (420) : below);
            if (panel) panel->component->setBounds (below);
        }
        inspector.setBounds (area.removeFromRight (304));
        canvas.setBounds (area);
    }

    /// A preset opens in place of the graph, and runs.
    void openAndStart (const std::string& preset)
    {
        playback.run().stop();
        document.open (load (preset), {}, "open");
        if (panel && panel->restore) panel->restore();
        playback.startOther ({});
    }

    void select (const std::string& node)
    {
        canvas.select ({ document.graph().root.find (node)->id });
        settle();
    }

    /// The point of the screen at a place of the canvas.
    juce::Point<float> onStage (juce::Point<float> on_canvas) { return stage->getLocalPoint (&canvas, canvas.view().toPixels (on_canvas)); }

    const graph::Graph& graph() const { return document.graph(); }
    bool start (const LiveRun::Hand& by = {})
    {
        playback.start (by);
        return waitFor ([&] { return playback.run().isRunning() && playback.run().tool(); });
    }

private:
    void timerCallback() override
    {
        refresh();
        live.refresh();
        inspector.refreshLive();
        if (hand) hand->refresh();
        if (focused() == nullptr && stage->hasKeyboard()) canvas.grabKeyboardFocus();   // what lets go of the keyboard leaves it to the canvas
    }

    void connect()
    {
        desk.hint = canvas.onHint = inspector.onHint = [this] (const juce::String& text) { status.hint (text); };
        desk.notify = [this] (const juce::String& text) { status.notify (text); };
        desk.refuse = canvas.onNotice = inspector.onNotice = [this] (const juce::String& text) { status.refuse (text); };
        desk.show = [this] (const std::string& patch, graph::Id id) { canvas.show (patch, id); };
        desk.leave = [this] { canvas.grabKeyboardFocus(); };
        desk.layerOf = [this] (const std::string& sink, const std::string& port) { return compose::mixIn (document.graph(), sink, port, catalogue()); };
        canvas.onSelection = [this] { inspector.inspect (canvas.seen(), canvas.selection()); };
        canvas.onBreadcrumbs = canvas.onSelection;
        canvas.onParamMenu = [this] (juce::PopupMenu& menu, const std::string& node, const std::string& port) { inspector.fillParamMenu (menu, node, port); };
        canvas.onEditParams = [this] { inspector.focusFirst(); };
        canvas.onWireOutside = [this] (const PortId& start, juce::Point<int> screen) {
            if (const auto control = inspector.controlAt (screen); ! control.empty()) canvas.commands().joinControl (start, control);
        };
        inspector.knobs().onModulate = [this] (const auto& control, const auto& type) { canvas.commands().addModulatorOf (control, type); };
        canvas.onProbe = [this] (const auto& ports) { desk.probe (ports); };
        canvas.onGraphDropped = [this] (const std::filesystem::path& file, juce::Point<float> at) { addGraph (desk, file, {}, at); };
        canvas.onTypeDropped = [this] (const std::string& type, const NodeRequest& request) { host::addNode (desk, type, request); };
        desk.addNode = [this] (const std::string& type) {
            host::addNode (desk, type, { canvas.view().toCanvas (canvas.getLocalBounds().getCentre().toFloat()) });
        };
        canvas.completeRemoval = [this] (graph::Batch removal) { return compose::withLeftovers (document.graph(), std::move (removal), catalogue()); };
        canvas.onLayerPasted = [this] (const graph::Graph& g) { pasteLayer (desk, g); };
        inspector.onModulate = [this] (const auto& node, const auto& param, const auto& type) { canvas.commands().addModulator (node, param, type); };
        inspector.messagesNow = [this] { return playback.run().messages(); };
        inspector.valuesNow = [this] (const std::string& param) { return live.valuesOf (param); };
    }
};

}   // namespace tactus::host::test
