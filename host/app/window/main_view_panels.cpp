// SPDX-License-Identifier: GPL-3.0-or-later
// What the window does when its panels call it.
#include "main_view.hpp"

#include <host/app/adding/add_graph.hpp>
#include <host/app/canvas/picture/save_picture.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>
#include <host/devices/sessions/audio_settings.hpp>

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

bool MainView::hasBoundRole() const
{
    return std::ranges::any_of (rolesNamed (edited.graph()), [this] (const std::string& role) { return bindsTool (role); });
}

/// A sound card moves no tool.
bool MainView::bindsTool (const std::string& role) const
{
    const auto* bound = device_setup.session().session.binding (role);
    return bound != nullptr && ! audio::isAudio (*bound);
}

/// The mouse or the gesture that the user has chosen goes on to the next graph. A device does only if the session binds it to a role of that name.
void MainView::startOpened (bool by_pointer)
{
    const auto& chosen = hand.chosen();
    if (chosen.kind != LiveRun::Hand::Kind::described && hasTool (edited.graph())) return playback.startOther (chosen);
    playback.startOther (by_pointer && ! hasBoundRole() ? LiveRun::Hand::pointer() : LiveRun::Hand {});
}

void MainView::chooseNode (const NodeRequest& request)
{
    const auto choose_type = [this, request] (const std::string& type) {
        const bool begins = edited.graph().root.nodes.empty();
        if (const auto* chosen = begins ? templateOf (type, templates.all()) : nullptr) return feel (chosen->file, false);
        const auto shipped = desk.presets();
        if (const auto* chosen = begins ? nullptr : templateOf (type, shipped)) return addGraph (desk, chosen->file, {}, request.at);
        addNode (type, request);
    };
    openNodePalette (palette, patching, catalogue, request, settings.recent_types, templates.all(), desk.presets(), choose_type);
}

void MainView::addNode (const std::string& type, const NodeRequest& request)
{
    patching.commands().addNodeAt (type, request);
    noteType (type);
    takeFocus (patching);
}

void MainView::noteType (const std::string& type)
{
    if (catalogue.find (type) == nullptr) return;   // a subgraph, which other graphs do not have
    settings.noteType (type);
    saveSettingsSoon();
}

void MainView::showBeginnings()
{
    const auto canvas = patching.getBounds();
    const int height = templates.heightFor (canvas.getWidth()), top = std::min (canvas.getHeight() / 2 + 20, canvas.getHeight() - height);
    templates.setBounds (canvas.withTrimmedTop (top).withHeight (height));
    patching.placeHint (top - 10);
    templates.setVisible (edited.graph().root.nodes.empty() && patching.patch().empty() && patching.isVisible());
}

void MainView::savePictureAs()
{
    const auto& name = edited.graph().name;
    const auto legal = juce::File::createLegalFileName (juce::String (name.empty() ? "canvas" : name)).toStdString();
    desk.chooseOwnFile (legal + ".svg", [this] (const std::filesystem::path& file) {
        const auto saved = savePicture (patching, file);
        status.notify (saved ? filled (TRANS ("Saved %1"), file.string()) : juce::String (messageText (saved.error())));
    });
}

void MainView::beginTour()
{
    if (welcome.isVisible() && ! welcome.cards().empty()) feel (welcome.cards().front().file, true);
    tour.begin (
        { { &hand, TRANS ("Feel it"),
            TRANS ("Press and drag on this surface: the mouse is your hand, and the arrow is the force on it. The list above it lets a gesture move the "
                   "hand instead.") },
          { &inspector, TRANS ("Turn a knob"),
            TRANS ("While nothing is selected, the controls of the graph are here. Drag one while you press. With a node selected, its "
                   "parameters are here.") },
          { &patching, TRANS ("Change how it is made"),
            TRANS ("A box is a node, and a wire carries what one node gives to the next. Space adds a node. Drag from port to port to wire them; "
                   "ports that fit light up. Ctrl+Z undoes anything.") },
          { &bottom, TRANS ("See what you feel"),
            TRANS ("Scopes plot the force while you feel it. Select a wire and press P to plot what it carries. Takes, layers, devices and problems are "
                   "beside them.") },
          { &strip, TRANS ("Stop at any time"),
            TRANS ("Esc or STOP lets all forces go to zero, and F5 or START begins again. Other presets and all nodes are at the left, and F1 "
                   "helps. The tour is in the menu.") } });
}

void MainView::choose (const juce::String& purpose, PaletteSearch search, std::function<void (const std::string&)> chosen)
{
    openPalette (palette, patching, purpose, std::move (search), std::move (chosen));
}

void MainView::feel (const std::filesystem::path& preset, bool by_pointer)
{
    files.openCopy (preset, by_pointer);
    turnTo (hand);
    if (files.isSafe())
        status.notify (TRANS ("Safe mode: press START or F5, then press and drag on the surface of the hand."));
    else if (hasBoundRole() && hand.chosen().kind == LiveRun::Hand::Kind::described)
        status.notify (TRANS ("The device chosen in the Devices panel moves the tool. Press and drag on the surface of the hand, and the mouse does."));
    else
        status.notify (by_pointer ? TRANS ("Press and drag on the surface of the hand: the mouse is your hand.")
                                  : TRANS ("The hand moves by itself. Press and drag on its surface, and the mouse is your hand."));
}

void MainView::rememberScene()
{
    settings.scene = hand.showsScene();
    saveSettingsSoon();
}

void MainView::rememberFilmLength()
{
    settings.film_s = hand.film().length();
    saveSettingsSoon();
}

void MainView::openOscPort (const OscListen& where)
{
    auto opened = OscPort::open (where);
    if (! opened) return status.notify (juce::String (opened.error().where + ": " + messageText (opened.error())));
    osc_server = std::make_unique<OscServer> (std::move (*opened), playback, edited, [this] { return question.isOpen(); });
    osc_server->onMessage = [this] { wake(); };
}

}   // namespace tactus::host
