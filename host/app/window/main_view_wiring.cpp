// SPDX-License-Identifier: GPL-3.0-or-later
// The connections between the parts of the window.
#include "graph_commands.hpp"
#include "main_view.hpp"

#include <host/app/adding/add_graph.hpp>
#include <host/app/adding/node_palette.hpp>
#include <host/app/compose/banks.hpp>
#include <host/app/compose/removal.hpp>
#include <host/app/desk/save_clip.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/file/graph_file.hpp>

namespace tactus::host
{

namespace
{
juce::String textAbout (const OscServer* server)
{
    if (server == nullptr)
        return TRANS ("No OSC messages are received. Another program may have the port. `tactus-host --osc 0` takes any free port.");
    auto text = filled (TRANS ("OSC messages to the UDP port %1 set parameters, turn controls, probe ports, and stop the run: "
                               "`tactus set roughness=0.5`, or /tactus/control with a name and a number from 0 to 1. docs/osc.md lists them."),
                        server->port());
    if (const auto losses = server->losses(); ! losses.empty()) text += "\n\n" + filled (TRANS ("Packets or messages dropped: %1"), losses);
    return text;
}
}   // namespace

Files::Callbacks MainView::fileCallbacks()
{
    return {
        .notify = [this] (const juce::String& text) { parts.status.notify (text); },
        .stop = [this] {
            parts.hand.film().end();   // the next run begins another film
            beginnings.stop(); },
        .run = [this] (bool by_pointer) { beginnings.run (by_pointer); },
        .isRunning = [this] { return parts.playback.current().isRunning(); },
        .isStopped = [this] {
            auto& current = parts.playback.current();
            return ! run().isWaiting() && (! current.isRunning() || current.isStoppedForGood()); },
        .isByPointer = [this] { return run().hand() == LiveRun::Hand::pointer(); },
        .usePointer = [this] {
            if (! parts.hasBoundRole()) parts.playback.changeHand (LiveRun::Hand::pointer()); },
        .prepare = [this] (const graph::Graph& graph, const juce::String& name, std::function<void()> show) { assets.begin (graph, name, std::move (show)); },
        .openTake = [this] (const std::filesystem::path& take) { return parts.desk.recoverTake (take); },
        .onSettings = [this] {
            parts.desk.settingsChanged();
            for (const auto& p : parts.panels)
                if (p.panel.reload) p.panel.reload(); },
        .onWrite = [this] (graph::Graph& graph) {
            for (const auto& p : parts.panels)
                if (p.panel.keep) p.panel.keep (graph); },
        .choose = [this] (bool saves, const std::filesystem::path& begin,
                          std::function<void (const std::filesystem::path&)> chosen) { chooseFile (saves, begin, std::move (chosen)); }
    };
}

/// Sets the functions that panels ask the window for.
void MainView::setDesk()
{
    using Path = std::filesystem::path;
    chooseFile = [this] (bool saves, const Path& begin, std::function<void (const Path&)> chosen) { parts.dialogs.choose (saves, begin, std::move (chosen)); };
    auto& desk = parts.desk;
    desk.hint = [this] (const juce::String& text) { parts.status.hint (text); };
    desk.notify = [this] (const juce::String& text) { parts.status.notify (text); };
    desk.refuse = [this] (const juce::String& text) { parts.status.refuse (text); };
    desk.settingsChanged = [this] {
        parts.saver.saveSoon();
        wake();
    };
    parts.dialogs.onFolder = desk.settingsChanged;
    desk.liveMessages = [this] { return live_nodes ? live_nodes->messages() : Messages(); };
    desk.chooseFile = [this] (bool saves, const Path& begin, auto chosen) { chooseFile (saves, begin, std::move (chosen)); };
    desk.chooseInput = [this] (const juce::String& patterns, const Path& begin, auto chosen) {
        parts.dialogs.chooseInput (patterns, begin, std::move (chosen));
    };
    desk.openGraph = [this] (const Path& file) { open (file); };
    desk.openMade = [this] (const graph::Graph& made, const std::string& step, bool is_work, std::function<void()> then) {
        parts.files.openGraph (made, step, is_work, std::move (then));
    };
    desk.feel = [this] (const Path& preset, bool by_pointer) { beginnings.feel (preset, by_pointer); };
    desk.preview = [this] (const Path& file) { preview (file); };
    desk.endPreview = [this] {
        if (! parts.playback.isPreviewing()) return;
        parts.playback.endPreview();
        parts.status.notify ({});
    };
    auto& canvas = parts.patching;
    desk.addNode = [this, &canvas] (const std::string& type) {
        addNode (parts.desk, type, { canvas.view().toCanvas (canvas.getLocalBounds().getCentre().toFloat()) });
    };
    desk.show = [this, &canvas] (const std::string& patch, graph::Id id) {
        parts.turnTo (canvas);
        canvas.show (patch, id);
    };
    desk.turnToCanvas = [this, &canvas] { parts.turnTo (canvas); };
    desk.toFront = [this] (const juce::Component& panel) { parts.layout.toFront (panel); };
    desk.reveal = [this] (const juce::Component& panel) { parts.layout.reveal (panel); };
    desk.leave = [this] { takeFocus (keyboard.home()); };
    desk.useDevice = [this] { return parts.hand.useDevice(); };
    desk.layerOf = [this] (const std::string& sink, const std::string& port) {
        return compose::mixIn (parts.edited.graph(), sink, port, parts.catalogue);
    };
}

void MainView::preview (const std::filesystem::path& file)
{
    if (parts.files.isSafe()) return parts.status.notify (TRANS ("Safe mode: open the preset and press START to feel it."));
    auto loaded = loadGraph (file);
    if (hasErrors (loaded.messages)) return;   // the preset list shows them
    const auto name = juce::String (loaded.graph.name);
    parts.playback.preview (std::move (loaded.graph));
    parts.status.notify (filled (TRANS ("%1: previewing with its own gesture. Release to stop."), name));
}

void MainView::setKeys()
{
    const auto start = [this] {
        endTyping();
        if (! parts.playback.current().isRunning()) parts.playback.restart();   // as START does
    };
    const auto help = [this] { parts.help.isOpen() ? parts.help.close() : parts.showHelp(); };
    keyboard.keys = {
        { "ctrl + n", [this] { parts.files.create(); } },
        { "ctrl + o", [this] { parts.files.open(); } },
        { "ctrl + s", [this] { parts.files.save(); } },
        { "ctrl + shift + s", [this] { parts.files.saveAs(); } },
        { "F5", start },
        { "F6", [this] { parts.layout.nextPart (1); } },
        { "shift + F6", [this] { parts.layout.nextPart (-1); } },
        { "ctrl + k", [this] { search.open(); } },
        { "F3", [this] { search.open(); } },
        { "shift + F1", [this] { beginnings.tour(); } },
        { "F1", help },
        { "?", help },
        { "z", [this] { parts.layout.foldPanels(); } },
        { "h", [this] { parts.hand.view().hold(); } },
        { "c", [this] { parts.live.shows_costs = ! parts.live.shows_costs; } },
    };
}

void MainView::allowQuit (const std::function<void()>& quit)
{
    menu.onQuit = quit;
    keyboard.keys.push_back ({ "ctrl + q", quit });
}

void MainView::connect()
{
    auto& desk = parts.desk;
    auto& canvas = parts.patching;
    auto& inspector = parts.inspector;
    canvas.onHint = inspector.onHint = parts.hand.onHint = desk.hint;
    canvas.onNotice = inspector.onNotice = desk.refuse;
    canvas.onBreadcrumbs = [this] { documentChanged(); };
    canvas.onSelection = [this] { parts.inspector.inspect (parts.patching.seen(), parts.patching.selection()); };
    canvas.onParamMenu = [this] (juce::PopupMenu& m, const std::string& node, const std::string& port) { parts.inspector.fillParamMenu (m, node, port); };
    canvas.onEditParams = [this] {
        parts.turnTo (parts.inspector);
        parts.inspector.focusFirst();
    };
    canvas.onNodeRequested = [this] (const NodeRequest& request) { openNodePalette (parts.desk, parts.palette, parts.templates.all(), request); };
    canvas.onChoose = [this] (const auto& purpose, auto entries, auto chosen) {
        openPalette (parts.palette, parts.patching, purpose, std::move (entries), std::move (chosen));
    };
    canvas.onWireOutside = [this] (const PortId& start, juce::Point<int> screen) {
        if (const auto control = parts.inspector.controlAt (screen); ! control.empty())
            parts.patching.commands().joinControl (start, control);
    };
    canvas.onProbe = [this] (const auto& ports) { parts.desk.probe (ports); };
    canvas.onGraphDropped = [this] (const std::filesystem::path& file, juce::Point<float> at) { addGraph (parts.desk, file, {}, at); };
    canvas.completeRemoval = [this] (graph::Batch removal) { return compose::withLeftovers (parts.edited.graph(), std::move (removal), parts.catalogue); };
    canvas.onLayerPasted = [this] (const graph::Graph& g) { pasteLayer (parts.desk, g); };
    canvas.onTypeDropped = [this] (const std::string& type, const NodeRequest& request) { addNode (parts.desk, type, request); };
    canvas.onSaveClip = [this] (const std::filesystem::path& file) { saveClipAs (parts.desk, file); };

    inspector.onModulate = [this] (const auto& node, const auto& param, const auto& type) {
        parts.turnTo (parts.patching);
        parts.patching.commands().addModulator (node, param, type);
    };
    inspector.knobs().onModulate = [this] (const auto& control, const auto& type) {
        parts.turnTo (parts.patching);
        parts.patching.commands().addModulatorOf (control, type);
    };
    inspector.onChooseFile = desk.chooseInput;
    inspector.messagesNow = [this] { return run().messages(); };
    inspector.valuesNow = [this] (const std::string& param) { return parts.live.valuesOf (param); };

    parts.top.onHelp = [this] { parts.showHelp(); };
    parts.top.onMenu = [this] (juce::Component& at) { menu.open (at); };
    menu.onTour = [this] { beginnings.tour(); };
    menu.onFind = [this] { search.open(); };
    menu.onOsc = [this] { parts.desk.tell (TRANS ("Remote control (OSC)"), textAbout (osc_server.get())); };
    parts.strip.onProblems = parts.strip.limitLight().onClick = [this] { parts.desk.showProblems(); };
    parts.live.limits = &parts.limits;
    parts.help.onExample = [this] (const std::string& type) { openExample (parts.desk, type); };

    auto& hand = parts.hand;
    hand.onEnlarge = [this] { resized(); };
    hand.onSceneToggled = [this] {
        parts.settings.scene = parts.hand.showsScene();
        parts.desk.settingsChanged();
    };
    hand.scene().reachesNow = desk.reaches;
    hand.scene().onMoveOrigin = desk.moveOrigin;
    hand.film().onLength = [this] {
        parts.settings.film_s = parts.hand.film().length();
        parts.desk.settingsChanged();
    };
    hand.film().onChoose = [this] (const std::filesystem::path& begin, auto chosen) { chooseFile (true, begin, std::move (chosen)); };
}

void MainView::listenForOsc (const OscListen& where)
{
    auto opened = OscPort::open (where);
    if (! opened) return parts.status.notify (juce::String (opened.error().where + ": " + messageText (opened.error())));
    osc_server = std::make_unique<OscServer> (std::move (*opened), parts.playback, parts.edited, [this] { return parts.question.isOpen(); });
    osc_server->onMessage = [this] { wake(); };
}

}   // namespace tactus::host
