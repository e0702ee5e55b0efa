// SPDX-License-Identifier: GPL-3.0-or-later
#include "scope_panel.hpp"

#include <host/app/look/size_in_view.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>

#include <array>

namespace tactus::host
{

namespace
{
constexpr std::array scope_kinds { ScopeKind::time, ScopeKind::over, ScopeKind::spectrum, ScopeKind::spectrogram, ScopeKind::energy, ScopeKind::tool };
}

ScopePanel::ScopePanel (Document& d, Traces& t, const Catalogue& c) : document (d), catalogue (c), traces (t), client (t)
{
    setTitle (TRANS ("Scopes"));
    setWantsKeyboardFocus (true);
    for (const auto kind : scope_kinds)
    {
        auto& b = *adders.emplace_back (std::make_unique<FlatButton> ("+ " + titleOf (kind)));
        b.setTooltip (TRANS ("Adds a scope"));
        b.onClick = [this, kind] { offer (kind); };
        addAndMakeVisible (b);
    }
    more.setTooltip (TRANS ("Adds a scope"));
    more.onClick = [this] { openAdders(); };
    addChildComponent (more);
    scroll.setViewedComponent (&scope_row, false);
    scroll.setScrollBarsShown (true, true);
    scroll.setScrollBarThickness (8);
    scroll.setWantsKeyboardFocus (false);
    addAndMakeVisible (scroll);
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

void ScopePanel::offer (ScopeKind kind)
{
    if (model.scopes.size() < most_scopes)
        add (kind);
    else if (onHint)
        onHint (filled (TRANS ("At most %1 scopes; close one first"), most_scopes));
}

void ScopePanel::openAdders()
{
    juce::PopupMenu menu;
    for (const auto kind : scope_kinds)
        menu.addItem (titleOf (kind), [safe = juce::Component::SafePointer (this), kind] {
            if (safe != nullptr) safe->offer (kind);
        });
    menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (more));
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
    scope_row.addAndMakeVisible (v);
}

/// Scrolls as far as it takes to show all of this scope.
void ScopePanel::reveal (const ScopeView& v)
{
    const int left = scroll.getViewPositionX(), right = left + scroll.getViewWidth();
    if (v.getX() < left) scroll.setViewPosition (v.getX(), scroll.getViewPositionY());
    if (v.getRight() > right) scroll.setViewPosition (v.getRight() - scroll.getViewWidth(), scroll.getViewPositionY());
}

ScopeView& ScopePanel::add (ScopeKind kind)
{
    model.scopes.push_back (std::make_unique<ScopeSpec> (suggestedScope (kind, document.graph(), catalogue)));
    showView (*model.scopes.back());
    model.active = model.scopes.back().get();
    requestPorts();
    resized();
    reveal (*views.back());
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
    const bool is_new = model.scopes.size() > scopes_before;
    if (is_new) showView (*model.scopes.back());
    requestPorts();
    resized();
    if (is_new) reveal (*views.back());
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
    if (onHint) onHint (written ? filled (TRANS ("Saved %1"), file.getFullPathName()) : juce::String (messageText (written.error())));
}

juce::Rectangle<int> ScopePanel::emptyArea() const { return getLocalBounds().withTrimmedTop (row_height); }

void ScopePanel::ScopeRow::paint (juce::Graphics& g)
{
    g.setColour (themeOf (*this).hairline);
    for (const auto* view : getChildren())
        if (view->getX() > 0) g.drawVerticalLine (view->getX() - 1, 0.0f, static_cast<float> (getHeight()));
}

void ScopePanel::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.fillAll (theme.panel);
    if (warned.isNotEmpty())
    {
        const auto row = getLocalBounds()
                             .removeFromTop (row_height)
                             .withLeft ((more.isVisible() ? more.getRight() : adders.back()->getRight()) + 12)
                             .withRight (freeze_button.getX() - 8);
        g.setFont (look.font (12.0f));
        g.setColour (theme.warning);
        g.drawText (warned, row, juce::Justification::centredRight, true);
    }
    if (! views.empty()) return;
    g.setFont (look.font (13.0f));
    g.setColour (theme.dim);
    auto text = TRANS ("Scopes plot what the wires of a graph carry. Open a preset to see some.");
    if (suggestion.isVisible())
        text = TRANS ("No scopes. Select a wire and press P, add a scope above, or start with this port:");
    else if (! context.ports.empty())
        text = TRANS ("No scopes. Select a wire and press P, or add a scope above.");
    g.drawFittedText (text, emptyArea().reduced (24, 16).withTrimmedBottom (32), juce::Justification::centred, 2, 1.0f);
}

void ScopePanel::resized()
{
    auto area = getLocalBounds();
    auto row = area.removeFromTop (row_height).reduced (4, 3);
    freeze_button.setBounds (row.removeFromRight (freeze_button.wantedWidth()));
    int wanted = 0;
    for (const auto& a : adders)
        wanted += a->wantedWidth();
    more.setVisible (wanted > row.getWidth());
    more.setBounds (row.withWidth (std::min (row.getWidth(), more.wantedWidth())));
    for (auto& a : adders)
    {
        a->setVisible (! more.isVisible());
        a->setBounds (row.removeFromLeft (std::min (row.getWidth(), a->wantedWidth())));
    }

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
    scroll.setBounds (area);
    scroll.setVisible (! views.empty());
    layOutScopes();
    repaint();
}

/// Equally wide, but none too narrow or too low to read.
void ScopePanel::layOutScopes()
{
    const int count = static_cast<int> (views.size()), bar = scroll.getScrollBarThickness();
    const auto size = sizeInView (scroll.getLocalBounds(), { count * least_scope_width, least_scope_height }, bar);
    scope_row.setSize (size.width, size.height);
    auto area = scope_row.getLocalBounds();
    for (int i = 0; i < count; ++i)
        views[static_cast<std::size_t> (i)]->setBounds (area.removeFromLeft (area.getWidth() / (count - i)).withTrimmedLeft (i == 0 ? 0 : 1));
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
