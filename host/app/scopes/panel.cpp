// SPDX-License-Identifier: GPL-3.0-or-later
// The scopes in the window.
#include "scope_panel.hpp"

#include <host/app/desk/panel.hpp>

namespace tactus::host
{

Panel scopesPanel (Desk& desk)
{
    auto made = std::make_unique<ScopePanel> (desk.document, desk.playback.run().traces(), desk.types);
    auto* scopes = made.get();
    scopes->onHint = [&desk] (const juce::String& text) { desk.hint (text); };
    scopes->onChoose = [&desk] (const std::string& name, auto chosen) { desk.chooseOwnFile (name, std::move (chosen)); };
    scopes->selectedPorts = [&desk] { return desk.canvas.commands().selectedPorts(); };
    desk.probe = [&desk, scopes] (const Desk::Ports& ports) {
        scopes->probe (ports);
        desk.toFront (*scopes);
    };
    desk.probed = [scopes] {
        Desk::Ports all;
        for (const auto& scope : scopes->scopes().scopes)
            all.insert (all.end(), scope->ports.begin(), scope->ports.end());
        return all;
    };
    return { .name = TRANS ("Scopes"),
             .component = std::move (made),
             .keys = { { "x", NEEDS_TRANS ("X"), NEEDS_TRANS ("freezes or unfreezes all scopes"), [scopes] { scopes->freezeAll (! scopes->isFrozen()); } } },
             .refresh =
                 [&desk, scopes] {
                     if (const auto& run = desk.playback.run(); run.isRunning()) scopes->setHandDelay (run.handDelay());
                     if (scopes->isVisible()) scopes->refresh();
                 },
             .keep = [scopes] (graph::Graph& graph) { scopes->keepIn (graph); },
             .restore = [scopes] { scopes->showOwn(); } };
}

}   // namespace tactus::host
