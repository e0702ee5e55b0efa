// SPDX-License-Identifier: GPL-3.0-or-later
#include "scope_panel.hpp"

#include <host/app/text/filled.hpp>

namespace tactus::host
{

ScopePanel::ScopePanel (Document& d, Traces& t, const Catalogue& c) : document (d), catalogue (c), traces (t), client (t)
{
    setTitle (TRANS ("Scopes"));
    setWantsKeyboardFocus (true);
    for (const auto kind : { ScopeKind::time, ScopeKind::over, ScopeKind::spectrum, ScopeKind::spectrogram, ScopeKind::energy, ScopeKind::tool })
    {
        auto& b = *adders.emplace_back (std::make_unique<FlatButton> ("+ " + titleOf (kind)));
        b.setTooltip (TRANS ("Adds a scope"));
        b.onClick = [this, kind] {
            if (model.scopes.size() < most_scopes)
                add (kind);
            else if (onHint)
                onHint (filled (TRANS ("At most %1 scopes; close one first"), most_scopes));
        };
        addAndMakeVisible (b);
    }
    freeze_button.setTooltip (TRANS ("Freezes all scopes, or lets them continue. The run is not affected. Key: X"));
    freeze_button.onClick = [this] { freezeAll (! isFrozen()); };
    addAndMakeVisible (freeze_button);
    suggestion.onClick = [this] { probe (suggestion.getName().toStdString()); };
    addChildComponent (suggestion);

    context.onChange = [this] {
        requestPorts();
        for (auto& v : views)
            v->redraw();
    };
    document.add (*this);
    suggest();
}

void ScopePanel::suggest()
{
    listPorts();
    views.clear();
    model = {};
    for (auto& s : suggestedScopes (document.graph(), catalogue))
        model.scopes.push_back (std::make_unique<ScopeSpec> (std::move (s)));
    for (auto& s : model.scopes)
        showView (*s);
    requestPorts();
    resized();
}

ScopePanel::~ScopePanel() { document.remove (*this); }

void ScopePanel::listPorts()
{
    context.ports = scopePorts (document.graph(), catalogue);
    context.energies = energyPorts (context.ports);
}

void ScopePanel::documentChanged()
{
    const auto before = context.ports;
    listPorts();
    follow (model, before, context.ports);
    requestPorts();
    resized();
}

void ScopePanel::requestPorts()
{
    std::vector<std::string> wanted;
    for (const auto& s : model.scopes)
        for (const auto& p : portsOf (*s, context.energies))
            if (isThere (p, context.ports) && std::ranges::count (wanted, p) == 0) wanted.push_back (p);
    client.want (std::move (wanted));
}

void ScopePanel::showView (ScopeSpec& s)
{
    auto& v = *views.emplace_back (std::make_unique<ScopeView> (s, context, [this] (const std::string& port) { return client.of (port); }));
    v.onClose = [this, &s] {
        juce::MessageManager::callAsync ([safe = juce::Component::SafePointer (this), which = &s] {
            if (safe != nullptr) safe->close (*which);
        });
    };
    v.onFreeze = [this] { freeze_button.setToggleState (isFrozen(), juce::dontSendNotification); };
    v.onSave = [this, &v] (juce::Component& below) { save (v, below); };
    v.addMouseListener (this, true);
    addAndMakeVisible (v);
}

ScopeView& ScopePanel::add (ScopeKind kind)
{
    model.scopes.push_back (std::make_unique<ScopeSpec> (suggestedScope (kind, document.graph(), catalogue)));
    showView (*model.scopes.back());
    model.active = model.scopes.back().get();
    requestPorts();
    resized();
    views.back()->refresh();
    return *views.back();
}

void ScopePanel::close (const ScopeSpec& s)
{
    const auto at = std::ranges::find (model.scopes, &s, &std::unique_ptr<ScopeSpec>::get);
    if (at == model.scopes.end()) return;
    if (model.active == &s) model.active = nullptr;
    views.erase (views.begin() + (at - model.scopes.begin()));
    model.scopes.erase (at);
    requestPorts();
    resized();
}

bool ScopePanel::probe (const std::string& port)
{
    const auto scopes_before = model.scopes.size();
    const bool is_shown = model.probe (port);
    if (model.scopes.size() > scopes_before) showView (*model.scopes.back());
    requestPorts();
    resized();
    return is_shown;
}

bool ScopePanel::isFrozen() const
{
    return ! views.empty() && std::ranges::all_of (views, [] (const auto& v) { return v->isFrozen(); });
}

void ScopePanel::freezeAll (bool on)
{
    for (auto& v : views)
        v->freeze (on);
    freeze_button.setToggleState (isFrozen(), juce::dontSendNotification);
}

juce::String ScopePanel::warning() const
{
    const auto& too_many = traces.leftOut();
    if (too_many.empty()) return {};
    const auto text = too_many.size() == 1 ? TRANS ("At most %1 components are recorded; not shown: %2. Close a scope or remove a port")
                                           : TRANS ("At most %1 components are recorded; not shown: %2 and %3 more. Close a scope or remove a port");
    return filled (text, ProbeRing::most, too_many.front(), too_many.size() - 1);
}

void ScopePanel::refresh()
{
    for (auto& v : views)
        v->refresh();
    if (const auto now = warning(); now != warned)
    {
        warned = now;
        repaint();
    }
}

void ScopePanel::save (ScopeView& view, juce::Component& below)
{
    const auto folder = juce::File::getSpecialLocation (juce::File::userDocumentsDirectory).getChildFile ("Tactus");
    const auto& graph = document.graph().name;
    const auto time = juce::Time::getCurrentTime().formatted (" %Y-%m-%d %H-%M-%S");
    const auto name = juce::String (graph.empty() ? "scope" : graph) + " " + titleOf (view.shown().kind).toLowerCase() + time;
    juce::PopupMenu menu;
    const auto add = [&] (const juce::String& label, const char* extension, auto write) {
        const auto file = folder.getChildFile (juce::File::createLegalFileName (name + extension));
        menu.addItem (label, [safe = juce::Component::SafePointer (this), which = juce::Component::SafePointer (&view), file, write] {
            if (safe == nullptr || which == nullptr) return;
            file.getParentDirectory().createDirectory();
            safe->report (write (*which, file.getFullPathName().toStdString()), file);
        });
    };
    add (TRANS ("Image (PNG)"), ".png", [] (ScopeView& v, const std::filesystem::path& p) { return v.saveImage (p); });
    add (TRANS ("Data (CSV)"), ".csv", [] (ScopeView& v, const std::filesystem::path& p) { return v.saveData (p); });
    menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (below));
}

void ScopePanel::report (const Result<>& written, const juce::File& file)
{
    if (onHint) onHint (written ? filled (TRANS ("Saved %1"), file.getFullPathName()) : juce::String (describe (written.error())));
}

juce::Rectangle<int> ScopePanel::emptyArea() const { return getLocalBounds().withTrimmedTop (row_height); }

void ScopePanel::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.fillAll (theme.panel);
    g.setColour (theme.hairline);
    for (std::size_t i = 1; i < views.size(); ++i)
        g.drawVerticalLine (views[i]->getX() - 1, static_cast<float> (row_height), static_cast<float> (getHeight()));
    if (warned.isNotEmpty())
    {
        const auto row = getLocalBounds().removeFromTop (row_height).withLeft (adders.back()->getRight() + 12).withRight (freeze_button.getX() - 8);
        g.setFont (look.font (12.0f));
        g.setColour (theme.warning);
        g.drawText (warned, row, juce::Justification::centredRight, true);
    }
    if (! views.empty()) return;
    g.setFont (look.font (13.0f));
    g.setColour (theme.dim);
    const auto text = suggestion.isVisible() ? TRANS ("No scopes. Select a wire and press P, add a scope above, or start with this port:")
                                              : TRANS ("No scopes. Add nodes to the graph, select a wire, and press P");
    g.drawFittedText (text, emptyArea().reduced (24, 16).withTrimmedBottom (32), juce::Justification::centred, 2);
}

void ScopePanel::resized()
{
    auto area = getLocalBounds();
    auto row = area.removeFromTop (row_height).reduced (4, 3);
    freeze_button.setBounds (row.removeFromRight (freeze_button.wantedWidth()));
    for (auto& a : adders)
        a->setBounds (row.removeFromLeft (std::min (row.getWidth(), a->wantedWidth())));

    const auto& first = std::ranges::find_if (context.ports,
                                              [] (const ScopePort& p) { return p.port.role == Role::output && p.port.quantity() == Quantity::force; });
    suggestion.setVisible (views.empty() && first != context.ports.end());
    if (suggestion.isVisible())
    {
        suggestion.setName (juce::String (first->name));
        suggestion.setButtonText (juce::String (first->name));
        suggestion.dot = themeOf (*this).of (Quantity::force);
        suggestion.setBounds (emptyArea().withSizeKeepingCentre (suggestion.wantedWidth(), FlatButton::height).translated (0, 16));
    }
    for (std::size_t i = 0; i < views.size(); ++i)
        views[i]->setBounds (area.removeFromLeft (area.getWidth() / static_cast<int> (views.size() - i)).withTrimmedLeft (i == 0 ? 0 : 1));
    repaint();
}

bool ScopePanel::keyPressed (const juce::KeyPress& key)
{
    if (key != juce::KeyPress ('x')) return false;
    freezeAll (! isFrozen());
    return true;
}

void ScopePanel::mouseDown (const juce::MouseEvent& e)
{
    for (const auto& v : views)
        if (v.get() == e.eventComponent || v->isParentOf (e.eventComponent)) model.active = &v->shown();
}

}   // namespace tactus::host
