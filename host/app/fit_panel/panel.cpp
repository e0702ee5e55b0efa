// SPDX-License-Identifier: GPL-3.0-or-later
// The panel in the window that fits a model to a recording.
#include "fit_panel.hpp"
#include "fitted_nodes.hpp"

#include <host/app/desk/panel.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
void insert (const Desk& desk, const FittedGraph& made)
{
    Selection added;
    auto command = addFitted (desk.document.graph(), desk.canvas.patch(), made, desk.canvas.types(), added);
    if (! command) return desk.notify (fromUtf8 (command.error().text));
    if (desk.canvas.commands().performPlaced (*std::move (command)).empty()) return;
    desk.canvas.select (added);
    const auto isWired = [&] (const SceneWire& w) {
        return added.contains (desk.canvas.scene().nodes()[static_cast<std::size_t> (w.start)].id)
               != added.contains (desk.canvas.scene().nodes()[static_cast<std::size_t> (w.end)].id);
    };
    desk.notify (std::ranges::any_of (desk.canvas.scene().wires(), isWired)
                     ? TRANS ("Added the fitted node, with the wires that go without saying. One undo takes it away.")
                     : TRANS ("Added the fitted node. Wire it to feel it."));
}
}   // namespace

Panel fitPanel (Desk& desk)
{
    auto made = std::make_unique<FitPanel>();
    auto* fit = made.get();
    fit->onOpenGraph = [&desk, fit] (const FittedGraph& g) {
        desk.openMade (g.preset, filled (TRANS ("fit %1"), g.preset.name).toStdString(), true, [fit] { fit->close(); });
    };
    fit->onInsert = [&desk] (const FittedGraph& g) { insert (desk, g); };
    desk.fitRecording = [&desk, fit] (const std::filesystem::path& file) {
        desk.settings.recordings = file.parent_path();
        desk.settingsChanged();
        fit->open (file);
    };
    return { .name = TRANS ("Fit"), .component = std::move (made), .escape = [fit] { fit->close(); }, .refresh = [fit] { fit->poll(); } };
}

}   // namespace tactus::host
