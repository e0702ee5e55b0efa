// SPDX-License-Identifier: GPL-3.0-or-later
#include "beginnings.hpp"

#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
/// True if a graph has a tool with a place, which the mouse or a gesture can move.
bool hasTool (const graph::Graph& g)
{
    const auto reads = [] (const graph::Patch& p) { return std::ranges::count (p.nodes, "device.position", &graph::Node::type) > 0; };
    return reads (g.root) || std::ranges::any_of (g.graphs, [&] (const auto& named) { return reads (named.second); });
}
}   // namespace

Beginnings::Beginnings (WindowParts& p) : parts (p)
{
    parts.welcome.onFeel = [this] (const std::filesystem::path& preset, bool by_pointer) { feel (preset, by_pointer); };
    parts.welcome.onNew = [this] { parts.files.create(); };
    parts.welcome.onOpen = [this] { parts.files.open(); };
    parts.welcome.onTour = [this] { tour(); };
    parts.templates.onChoose = [this] (const Preset& chosen) { feel (chosen.file, true); };
    parts.tour.onStep = [this] (const Tour::Step& step) {
        if (step.part != nullptr) parts.turnTo (*step.part);
        if (step.part == &parts.layout.bottom) parts.layout.bottom.show (0);
    };
    parts.tour.onEnd = [this] {
        parts.settings.toured = true;
        parts.desk.settingsChanged();
    };
}

void Beginnings::showWelcome()
{
    parts.welcome.show (parts.desk.presets(), ! parts.settings.toured);
    parts.welcome.setVisible (true);
}

void Beginnings::poll()
{
    if (! parts.welcome.isVisible()) return;
    const auto roles = parts.device_setup.session().session.roles();
    parts.welcome.refresh (std::ranges::any_of (roles, [this] (const std::string& role) { return parts.device_setup.movesTool (role); }));
}

void Beginnings::placeTemplates()
{
    auto& templates = parts.templates;
    auto& patching = parts.patching;
    const auto canvas = patching.getBounds();
    const int height = templates.heightFor (canvas.getWidth()), top = std::min (canvas.getHeight() / 2 + 20, canvas.getHeight() - height);
    templates.setBounds (canvas.withTrimmedTop (top).withHeight (height));
    patching.placeHint (top - 10);
    templates.setVisible (parts.edited.graph().root.nodes.empty() && patching.patch().empty() && patching.isVisible());
}

void Beginnings::feel (const std::filesystem::path& preset, bool by_pointer)
{
    parts.files.openCopy (preset, by_pointer);
    parts.turnTo (parts.hand);
    if (parts.files.isSafe())
        parts.status.notify (TRANS ("Safe mode: press START or F5, then press and drag on the surface of the hand."));
    else if (waitsForStart())
        parts.status.notify (TRANS ("You have stopped the device: press START or F5 to feel this graph on it."));
    else if (parts.hasBoundRole() && parts.hand.chosen().kind == LiveRun::Hand::Kind::described)
        parts.status.notify (TRANS ("The device chosen in the Devices panel moves the tool. Press and drag on the surface of the hand, and the mouse does."));
    else
        parts.status.notify (by_pointer ? TRANS ("Press and drag on the surface of the hand: the mouse is your hand.")
                                        : TRANS ("The hand moves by itself. Press and drag on its surface, and the mouse is your hand."));
}

void Beginnings::stop()
{
    noteStops();
    parts.playback.run().stop();
    own_stops = parts.playback.stopSwitch().personStops();
}

void Beginnings::noteStops()
{
    const auto& stops = parts.playback.stopSwitch();
    was_stopped = ! stops.mayStart() && (was_stopped || stops.personStops() != own_stops);
}

bool Beginnings::waitsForStart() const { return was_stopped && parts.hasBoundRole(); }

void Beginnings::run (bool by_pointer)
{
    noteStops();
    if (waitsForStart()) return;   // the panel of the hand says that nothing runs
    const auto& chosen = parts.hand.chosen();
    if (chosen.kind != LiveRun::Hand::Kind::described && hasTool (parts.edited.graph())) return parts.playback.startOther (chosen);
    parts.playback.startOther (by_pointer && ! parts.hasBoundRole() ? LiveRun::Hand::pointer() : LiveRun::Hand {});
}

void Beginnings::tour()
{
    if (const auto& cards = parts.welcome.cards(); parts.welcome.isVisible() && ! cards.empty()) feel (cards.front().file, true);
    parts.tour.begin (
        { { &parts.hand, TRANS ("Feel it"),
            TRANS ("Press and drag on this surface: the mouse is your hand, and the arrow is the force on it. The list above it lets a gesture move the "
                   "hand instead.") },
          { &parts.inspector, TRANS ("Turn a knob"),
            TRANS ("The knobs at the bottom are the controls of the graph. Drag one while you press. With a node selected, its parameters are "
                   "above.") },
          { &parts.patching, TRANS ("Change how it is made"),
            TRANS ("A box is a node, and a wire carries what one node gives to the next. Space adds a node. Drag from port to port to wire them; "
                   "ports that fit light up. Ctrl+Z undoes anything.") },
          { &parts.layout.bottom, TRANS ("See what you feel"),
            TRANS ("Scopes plot the force while you feel it. Select a wire and press P to plot what it carries. Takes, layers, devices and problems are "
                   "beside them.") },
          { &parts.strip, TRANS ("Stop at any time"),
            TRANS ("Esc or STOP lets all forces go to zero, and F5 or START begins again. Other presets and all nodes are at the left, and F1 "
                   "helps. The tour is in the menu.") } });
}

}   // namespace tactus::host
