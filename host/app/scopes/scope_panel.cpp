// SPDX-License-Identifier: GPL-3.0-or-later
#include "scope_panel.hpp"
#include "scope_file.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/size_in_view.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr std::array scope_kinds { ScopeKind::time, ScopeKind::over, ScopeKind::spectrum, ScopeKind::spectrogram, ScopeKind::energy, ScopeKind::tool };
constexpr double best_shape = 1.6;        // width by height of a scope
constexpr int least_in_grid = 200;        // units of the window: no second row if it makes scopes lower than this
constexpr double least_plot_px = 120.0;   // pixels of the screen
constexpr double least_share = 0.2;

/// A scope is no lower than this, in units of the window.
int leastHeight()
{
    const auto scale = static_cast<double> (juce::Desktop::getInstance().getGlobalScaleFactor());
    return ScopeView::header_height + static_cast<int> (std::ceil (least_plot_px / std::max (0.1, scale)));
}
}   // namespace

/// The edge between two scopes of a row. A drag sizes them, and a double click makes them equally wide.
class ScopePanel::Edge final : public juce::Component
{
public:
    static constexpr int width = 7;

    explicit Edge (ScopePanel& p) : panel (p)
    {
        setMouseCursor (juce::MouseCursor::LeftRightResizeCursor);
        setMouseClickGrabsKeyboardFocus (false);
        setTitle (TRANS ("Edge between scopes"));
    }

    void paint (juce::Graphics& g) override
    {
        if (! isMouseOverOrDragging()) return;
        g.setColour (themeOf (*this).accent);
        g.fillRect (getLocalBounds().withSizeKeepingCentre (2, getHeight()));
    }

    void mouseEnter (const juce::MouseEvent&) override { repaint(); }
    void mouseExit (const juce::MouseEvent&) override { repaint(); }

    void mouseDown (const juce::MouseEvent&) override
    {
        before = copiesOf (panel.model);
        grabbed = panel.views[right - 1]->getWidth();
    }

    void mouseDrag (const juce::MouseEvent& e) override
    {
        const int whole = panel.views[right - 1]->getWidth() + panel.views[right]->getWidth();
        const int way = e.getEventRelativeTo (getParentComponent()).getOffsetFromDragStart().x;
        const double both = before[right - 1].share + before[right].share, part = static_cast<double> (grabbed + way) / std::max (1, whole);
        size (std::clamp (part, least_share, 1.0 - least_share) * both, both);
    }

    void mouseUp (const juce::MouseEvent&) override { panel.addStep (NEEDS_TRANS ("size scopes"), before); }

    void mouseDoubleClick (const juce::MouseEvent&) override
    {
        before = copiesOf (panel.model);
        const double both = before[right - 1].share + before[right].share;
        size (0.5 * both, both);
        panel.addStep (NEEDS_TRANS ("size scopes"), before);
    }

private:
    void size (double left, double both)
    {
        panel.model.scopes[right - 1]->share = left;
        panel.model.scopes[right]->share = both - left;
        panel.layOutScopes();
    }

    ScopePanel& panel;
    Scopes before;
    int grabbed = 0;

public:
    std::size_t right = 1;   // the scope to its right
};

ScopePanel::ScopePanel (Document& d, Traces& t, const Catalogue& c) : document (d), catalogue (c), traces (t), client (t)
{
    setOpaque (true);
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
    suggestion.onClick = [this] { probe ({ suggestion.getName().toStdString() }); };
    addChildComponent (suggestion);

    context.onChange = [this] {
        requestPorts();
        for (auto& v : views)
            v->redraw();
    };
    document.add (*this);
    showOwn();
}

void ScopePanel::offer (ScopeKind kind)
{
    if (model.scopes.size() < most_scopes)
    {
        const auto before = copiesOf (model);
        add (kind);
        addStep (NEEDS_TRANS ("add scope"), before);
    }
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

void ScopePanel::showOwn()
{
    listPorts();
    const auto kept = readScopes (document.ui());
    restore (kept ? *kept : suggestedScopes (document.graph(), catalogue));
    suggested.reset();
    if (kept) return;
    suggested.emplace();
    for (const auto& s : model.scopes)
        suggested->scopes.push_back (std::make_unique<ScopeSpec> (*s));
}

void ScopePanel::keepIn (graph::Graph& graph) const
{
    auto scopes = writeScopes (copiesOf (model));
    if (suggested && scopes == writeScopes (copiesOf (*suggested))) return;
    auto& ui = graph.extra["ui"];
    if (! ui.is_object()) ui = Json::object();
    ui["scopes"] = std::move (scopes);
}

ScopePanel::Scopes ScopePanel::copiesOf (const ScopeModel& of)
{
    Scopes all;
    for (const auto& s : of.scopes)
        all.push_back (*s);
    return all;
}

void ScopePanel::restore (const Scopes& to)
{
    letGoOfFocus (scope_row);
    moved = nullptr;
    edges.clear();
    views.clear();
    model = {};
    for (auto s : to)
    {
        s.is_frozen = false;   // what it showed is gone
        model.scopes.push_back (std::make_unique<ScopeSpec> (std::move (s)));
    }
    for (auto& s : model.scopes)
        showView (*s);
    requestPorts();
    resized();
}

/// Makes a step of the history of what has changed since these scopes.
void ScopePanel::addStep (const char* name, const Scopes& before)
{
    const auto now = copiesOf (model);
    const auto isSame = [] (const ScopeSpec& a, const ScopeSpec& b) { return a.kind == b.kind && a.ports == b.ports && a.share == b.share; };
    if (std::ranges::equal (before, now, isSame)) return;
    const auto to = [safe = juce::Component::SafePointer (this)] (const Scopes& scopes) {
        return [safe, scopes] {
            if (safe != nullptr) safe->restore (scopes);
        };
    };
    document.addWindowStep (name, to (before), to (now));
}

ScopePanel::~ScopePanel() { document.remove (*this); }

void ScopePanel::listPorts()
{
    listed = document.version();
    context.ports = scopePorts (document.graph(), catalogue);
    context.names = PortNames (context.ports);
    context.energies = energyPorts (context.ports);
    ++context.edits;
    context.energies_left_out = context.energies.size() > most_energies ? context.energies.size() : 0;
    if (context.energies_left_out > 0) context.energies.clear();
}

void ScopePanel::documentChanged()
{
    if (listed != document.version())
    {
        const auto before = std::exchange (context.ports, {});
        listPorts();
        follow (model, before, context.ports);
        if (suggested) follow (*suggested, before, context.ports);
    }
    requestPorts();
    resized();
}

void ScopePanel::requestPorts()
{
    std::vector<std::string> wanted;
    std::set<std::string> known;
    for (const auto& s : model.scopes)
        for (const auto& p : portsOf (*s, context.energies))
            if (known.insert (p).second && context.names.has (p)) wanted.push_back (p);
    client.want (std::move (wanted));
}

void ScopePanel::showView (ScopeSpec& s)
{
    auto& v = *views.emplace_back (std::make_unique<ScopeView> (s, context, [this] (const std::string& port) { return client.of (port); }));
    v.onClose = [this, &s] {
        juce::MessageManager::callAsync ([safe = juce::Component::SafePointer (this), which = &s] {
            if (safe == nullptr) return;
            const auto before = safe->copiesOf (safe->model);
            safe->close (*which);
            safe->addStep (NEEDS_TRANS ("close scope"), before);
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
    auto made = std::make_unique<ScopeSpec> (suggestedScope (kind, document.graph(), catalogue));
    if (const auto selected = selectedPorts ? selectedPorts() : std::vector<std::string>(); holdsProbes (*made) && ! selected.empty())
    {
        made->ports.clear();
        for (const auto& port : selected)
            made->addPort (port);
    }
    model.scopes.push_back (std::move (made));
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
    edges.clear();
    const auto view = views.begin() + (at - model.scopes.begin());
    letGoOfFocus (**view);
    views.erase (view);
    model.scopes.erase (at);
    requestPorts();
    resized();
}

void ScopePanel::probe (const std::vector<std::string>& ports)
{
    const auto before = copiesOf (model);
    for (const auto& port : ports)
        model.probe (port);
    const bool is_new = model.scopes.size() > before.size();
    if (is_new) showView (*model.scopes.back());
    requestPorts();
    resized();
    if (is_new) reveal (*views.back());
    addStep (NEEDS_TRANS ("probe"), before);
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
    context.samples = client.changes();
    context.leaves_out = ! traces.leftOut().empty();
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
    const auto& graph = document.graph().name;
    const auto time = juce::Time::getCurrentTime().formatted (" %Y-%m-%d %H-%M-%S");
    const auto name = juce::String (graph.empty() ? "scope" : graph) + " " + titleOf (view.shown().kind).toLowerCase() + time;
    juce::PopupMenu menu;
    const auto add = [&] (const juce::String& label, const char* extension, auto write) {
        const auto file = juce::File::createLegalFileName (name + extension).toStdString();
        menu.addItem (label, [safe = juce::Component::SafePointer (this), which = juce::Component::SafePointer (&view), file, write] {
            if (safe == nullptr || ! safe->onChoose) return;
            safe->onChoose (file, [safe, which, write] (const std::filesystem::path& to) {
                if (safe != nullptr && which != nullptr) safe->report (write (*which, to), to);
            });
        });
    };
    add (TRANS ("Image (PNG)"), ".png", [] (ScopeView& v, const std::filesystem::path& p) { return v.saveImage (p); });
    add (TRANS ("Data (CSV)"), ".csv", [] (ScopeView& v, const std::filesystem::path& p) { return v.saveData (p); });
    menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (below));
}

void ScopePanel::report (const Result<>& written, const std::filesystem::path& file)
{
    if (onHint) onHint (written ? filled (TRANS ("Saved %1"), fromUtf8 (file.string())) : juce::String (messageText (written.error())));
}

juce::Rectangle<int> ScopePanel::emptyArea() const { return getLocalBounds().withTrimmedTop (row_height); }

void ScopePanel::ScopeRow::paint (juce::Graphics& g)
{
    g.setColour (themeOf (*this).hairline);
    g.fillAll();   // between the scopes
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

/// As many rows as make the scopes easiest to read; one row in a panel of the usual height.
std::size_t ScopePanel::columns() const
{
    const auto count = std::max<std::size_t> (1, views.size());
    std::size_t best = count;
    double least = std::numeric_limits<double>::max();
    for (std::size_t rows = 1; rows <= count; ++rows)
    {
        const auto across = (count + rows - 1) / rows;
        const double width = scroll.getWidth() / static_cast<double> (across), height = scroll.getHeight() / static_cast<double> (rows);
        if (rows > 1 && height < least_in_grid) break;
        if (const double off = std::abs (std::log (std::max (1.0, width) / std::max (1.0, height) / best_shape)); off < least)
        {
            least = off;
            best = across;
        }
    }
    return best;
}

/// By their shares of the width, but none too narrow or too low to read.
void ScopePanel::layOutScopes()
{
    const auto across = columns(), rows = (views.size() + across - 1) / across;
    const int bar = scroll.getScrollBarThickness(), wide = static_cast<int> (across), high = static_cast<int> (rows);
    const auto size = sizeInView (scroll.getLocalBounds(), { wide * least_scope_width, high * leastHeight() }, bar);
    scope_row.setSize (size.width, size.height);
    auto area = scope_row.getLocalBounds();
    std::size_t used = 0;
    for (std::size_t row = 0; row < rows; ++row)
    {
        auto line = area.removeFromTop (area.getHeight() / static_cast<int> (rows - row)).withTrimmedTop (row == 0 ? 0 : 1);
        const auto first = row * across, end = std::min (views.size(), first + across);
        double left = 0.0;
        for (auto i = first; i < end; ++i)
            left += model.scopes[i]->share;
        for (auto i = first; i < end; ++i)
        {
            const double share = model.scopes[i]->share;
            const int others = static_cast<int> (end - i) - 1;
            const int most = std::max (least_scope_width, line.getWidth() - others * least_scope_width);
            const int width = others == 0 ? line.getWidth() : std::clamp (juce::roundToInt (line.getWidth() * share / left), least_scope_width, most);
            left -= share;
            views[i]->setBounds (line.removeFromLeft (width).withTrimmedLeft (i == first ? 0 : 1));
            if (i == first) continue;
            if (used == edges.size()) scope_row.addAndMakeVisible (*edges.emplace_back (std::make_unique<Edge> (*this)));
            auto& edge = *edges[used++];   // the one that is being dragged stays
            edge.right = i;
            edge.toFront (false);
            edge.setBounds (views[i]->getBounds().withWidth (Edge::width).translated (-Edge::width / 2 - 1, 0));
        }
    }
    edges.resize (used);
}

bool ScopePanel::keyPressed (const juce::KeyPress& key)
{
    if (key != juce::KeyPress ('x')) return false;
    freezeAll (! isFrozen());
    return true;
}

void ScopePanel::mouseDown (const juce::MouseEvent& e)
{
    moved = nullptr;
    for (const auto& v : views)
        if (v.get() == e.eventComponent || v->isParentOf (e.eventComponent))
        {
            model.active = &v->shown();
            if (v.get() != e.eventComponent) continue;
            moved = model.active;   // its title
            before_drag = copiesOf (model);
        }
}

void ScopePanel::mouseDrag (const juce::MouseEvent& e)
{
    if (moved == nullptr || ! e.mouseWasDraggedSinceMouseDown()) return;
    const auto at = e.getEventRelativeTo (&scope_row).getPosition();
    for (std::size_t i = 0; i < views.size(); ++i)
        if (views[i]->getBounds().contains (at) && &views[i]->shown() != moved) return moveTo (i);
}

void ScopePanel::mouseUp (const juce::MouseEvent&)
{
    if (std::exchange (moved, nullptr) != nullptr) addStep (NEEDS_TRANS ("move scope"), before_drag);
}

/// Moves the dragged scope to a place in the row, and those in between by one.
void ScopePanel::moveTo (std::size_t place)
{
    const auto from = static_cast<std::size_t> (std::ranges::find (model.scopes, moved, &std::unique_ptr<ScopeSpec>::get) - model.scopes.begin());
    if (from >= views.size()) return;
    const auto shift = [&] (auto& list) {
        const auto begin = list.begin(), source = begin + static_cast<std::ptrdiff_t> (from), target = begin + static_cast<std::ptrdiff_t> (place);
        from < place ? std::rotate (source, source + 1, target + 1) : std::rotate (target, source, source + 1);
    };
    shift (model.scopes);
    shift (views);
    layOutScopes();
}

}   // namespace tactus::host
