// SPDX-License-Identifier: GPL-3.0-or-later
// What the window does on the callbacks of its panels, panel by panel.
#include "main_view.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

Files::Callbacks MainView::fileCallbacks()
{
    return {
        .notify = [this] (const juce::String& text) { status.notify (text); },
        .stop = [this] { run().stop(); },
        .run = [this] (bool by_pointer) { playback.startOther (by_pointer && ! hasBoundRole() ? LiveRun::Hand::pointer() : LiveRun::Hand {}); },
        .isRunning = [this] { return playback.current().isRunning(); },
        .onSettings = [this] {
            saveSettingsSoon();
            presets.reload(); },
        .choose = [this] (bool saves, const std::filesystem::path& begin,
                          std::function<void (const std::filesystem::path&)> chosen) { chooseFile (saves, begin, std::move (chosen)); }
    };
}

bool MainView::hasBoundRole() const
{
    const auto& session = device_setup.session().session;
    return std::ranges::any_of (rolesNamed (edited.graph()), [&] (const std::string& role) { return session.binding (role) != nullptr; });
}

void MainView::connectPresets()
{
    presets.onOpen = [this] (const Preset& p, bool is_own) {
        is_own ? files.open (p.file) : files.openCopy (p.file, false);
        if (! question.isOpen()) takeFocus (patching);   // what the user types next is for the graph, not for the search
    };
    presets.onSettings = [this] { saveSettingsSoon(); };
    presets.onPreview = [this] (const std::filesystem::path& file) { preview (file); };
    presets.onPreviewEnd = [this] { endPreview(); };
}

void MainView::connectCanvas()
{
    const auto hint = [this] (const juce::String& text) { status.hint (text); };
    patching.onHint = inspector.onHint = hand.onHint = scopes.onHint = layers.onHint = devices.onHint = takes.onHint = hint;
    patching.onNotice = [this] (const juce::String& text) { status.notify (text); };
    patching.onBreadcrumbs = [this] { documentChanged(); };
    patching.onSelection = [this] { inspector.inspect (patching.patch(), patching.selection()); };
    patching.onEditParams = [this] { inspector.focusFirst(); };
    patching.onNodeRequested = [this] (const NodeRequest& request) {
        openNodePalette (palette, patching, catalogue, request, settings.recent_types, [this] (const std::string& type) {
            if (catalogue.find (type) == nullptr) return;   // a subgraph, which other graphs do not have
            settings.noteType (type);
            saveSettingsSoon();
        });
    };
    patching.onChoose = [this] (const juce::String& purpose, auto entries, auto onChosen) {
        openPalette (palette, patching, purpose, std::move (entries), std::move (onChosen));
    };
    patching.onProbe = [this] (const std::vector<std::string>& ports) {
        for (const auto& port : ports)
            scopes.probe (port);
        bottom.show (scopes);
    };
    patching.onFileDropped = [this] (const std::filesystem::path& file) { files.open (file); };
    patching.onSaveClip = [this] (const std::filesystem::path& file) { saveClipAs (file); };
    inspector.messagesNow = [this] { return run().messages(); };
    layers.onSelect = [this] (const std::string& patch, graph::Id node) { patching.show (patch, node); };
    layers.onAdded = [this] (const std::string& patch, graph::Id node) {
        patching.show (patch, node);
        patching.endEdit();   // undoing the edit brings back the view from before
    };
    live.limits = &limits;
    devices.onTry = [this] (const std::string& role) { return playback.tryDevice (role); };
    strip.onProblems = [this] { bottom.show (problems); };
    strip.limitLight().onClick = [this] { bottom.show (problems); };
    problems.onShow = [this] (const Culprit& c) { patching.show (c.patch, c.id); };
}

void MainView::connectTopBar()
{
    top.onLeave = [this] (std::size_t depth) { patching.leaveTo (depth); };
    top.onInstance = [this] (int number) { patching.chooseInstance (number); };
    top.onRecall = [this] (int number) { recall (number); };
    top.onStore = [this] (int number) { store (number); };
    top.onHelp = [this] { helpOnSelection(); };
    top.onMenu = [this] (juce::Component& at) { openMenu (at); };
}

void MainView::connectWelcome()
{
    welcome.onFeel = [this] (const std::filesystem::path& file) {
        files.openCopy (file, true);
        status.notify (files.isSafe() ? TRANS ("Safe mode: press START, then press and drag on the surface below.")
                                      : TRANS ("Press and drag on the surface below: the mouse is your hand."));
    };
    welcome.onOpenFile = [this] (const std::filesystem::path& file) { files.open (file); };
    welcome.onNew = [this] { files.create(); };
    welcome.onOpen = [this] { files.open(); };
    help.onExample = [this] (const std::string& type) { openExample (type); };
}

void MainView::fitRecordingIn (const std::filesystem::path& file) { fitting.open (file); }

void MainView::connectFitPanel()
{
    fitting.onOpenGraph = [this] (const FittedGraph& made) { files.openGraph (made.preset, filled (TRANS ("fit %1"), made.preset.name).toStdString()); };
    fitting.onInsert = [this] (const FittedGraph& made) {
        auto source = made.preset;
        auto place = (patching.commands().pointerOrCentre() / Box::grid).roundToInt() * static_cast<int> (Box::grid);
        std::set<graph::Id> ids;
        for (auto& node : source.root.nodes)
        {
            if (std::ranges::count (made.nodes, node.name) == 0) continue;
            node.extra["ui"]["at"] = Json::array ({ place.x, place.y });
            place.y += 120;
            ids.insert (node.id);
        }
        Selection added;
        auto command = paste (edited.graph(), patching.patch(), copyText (source, {}, ids), {}, added);
        if (! command) return status.notify (fromUtf8 (command.error().text));
        if (! patching.commands().perform (*std::move (command))) return;
        patching.select (added);
        status.notify (TRANS ("Added the fitted node. Wire it to feel it."));
    };
}

void MainView::openOscPort (const OscListen& where)
{
    auto opened = OscPort::open (where);
    if (! opened) return status.notify (juce::String (opened.error().where + ": " + messageText (opened.error())));
    osc_server = std::make_unique<OscServer> (std::move (*opened), playback, edited, [this] { return question.isOpen(); });
}

}   // namespace tactus::host
