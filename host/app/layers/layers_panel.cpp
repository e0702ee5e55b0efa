// SPDX-License-Identifier: GPL-3.0-or-later
#include "layers_panel.hpp"

#include <host/app/look/focus.hpp>
#include <host/app/look/size_in_view.hpp>
#include <host/app/model/clip_graph.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/presets/preset_list.hpp>
#include <host/app/text/file_path.hpp>
#include <host/app/text/filled.hpp>
#include <host/base/files/clip_io.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tactus::host
{

namespace
{
constexpr int spectrum_every = 3;   // every third refresh updates the spectra
constexpr int button_line = 28;
juce::String headingOf (std::string_view family)
{
    if (family == "texture") return TRANS ("Textures");
    return family == "friction" ? TRANS ("Friction") : TRANS ("Vibrations");
}

constexpr auto introduction = NEEDS_TRANS ("A layer mixer mixes forces, textures and vibrations. Each layer has gain, mute and solo, and layers of higher "
                                           "priority can duck the others. The layers appear here as strips with faders and meters in newtons.");
/// The head is what adds layers and chooses a mixer. It is in the panel, or scrolls with the strips.
void placeIn (juce::Component& parent, std::initializer_list<juce::Component*> head)
{
    for (auto* c : head)
        if (c != nullptr && c->getParentComponent() != &parent) parent.addChildComponent (c);
}

void placeIn (juce::Component& parent, const std::vector<std::unique_ptr<ToolButton>>& buttons)
{
    for (const auto& b : buttons)
        placeIn (parent, { b.get() });
}
}   // namespace

LayersPanel::LayersPanel (Document& d, Traces& t, const Catalogue& c) : document (d), catalogue (c), traces (t, Traces::Rank::first),
                                                                        spectra (t, Traces::Rank::spare)
{
    setTitle (TRANS ("Layers"));
    for (const auto& kind : layerKinds())
    {
        const auto called = juce::translate (juce::String (kind.name));
        auto& b = *kinds.emplace_back (std::make_unique<ToolButton> ("+ " + called, ToolButton::Kind::framed, juce::translate (juce::String (kind.about))));
        b.setTitle (filled (TRANS ("Add a layer: %1"), called));
        b.onClick = [this, type = kind.type] { begin (type); };
        addAndMakeVisible (b);
    }
    more.onClick = [this] { openMenu(); };
    first.onClick = [this] { addMixerNow(); };
    scroll.setViewedComponent (&row, false);
    scroll.setScrollBarsShown (true, true);
    scroll.setScrollBarThickness (8);
    scroll.setWantsKeyboardFocus (false);   // the keys are for the strips
    addAndMakeVisible (scroll);
    addAndMakeVisible (more);
    addAndMakeVisible (first);
    document.add (*this);
    rebuild();
}

LayersPanel::~LayersPanel() { document.remove (*this); }

void LayersPanel::rebuild()
{
    const auto& graph = document.graph();
    auto found = mixersOf (graph);
    const auto same = std::ranges::find (found, chosen.id, &MixerPlace::id);
    MixerPlace next;
    if (! found.empty()) next = same != found.end() ? *same : found.front();
    const auto* node = found.empty() ? nullptr : findMixer (graph, next);
    const auto layers = node == nullptr ? std::size_t {} : static_cast<std::size_t> (layersOf (*node, catalogue));
    const bool other = next != chosen || layers != strips.size();
    const bool other_names = found != all || other;
    all = std::move (found);
    chosen = next;
    if (other_names) rebuildNames();
    if (other) rebuildStrips (layers);
    for (auto& s : strips)
        s->show();
    if (total) total->show();
    rebuildUnmixed();

    for (auto& b : kinds)
        b->setEnabled (true);
    more.setVisible (! all.empty());
    scroll.setVisible (! all.empty());
    first.setVisible (false);
    preview = {};
    if (isVisible()) proposeMixer();
    resized();
    repaint();
}

/// In a graph without a mixer, says where one would go. It looks at all nodes, so it is not done while the panel is hidden.
void LayersPanel::proposeMixer()
{
    if (! all.empty()) return;
    const auto added = addMixer (document.graph(), catalogue);
    preview = added ? juce::String (added->description) : filled (TRANS ("Cannot add a mixer: %1."), messageText (added.error()));
    first.setVisible (added.has_value());
    for (auto& b : kinds)
        b->setEnabled (added.has_value());
}

void LayersPanel::rebuildNames()
{
    names.clear();
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        auto& b = *names.emplace_back (std::make_unique<ToolButton> (juce::String (all[i].path), ToolButton::Kind::tab));
        b.setToggleState (all[i].id == chosen.id, juce::dontSendNotification);
        b.onClick = [this, i] { choose (i); };
        addAndMakeVisible (b);
    }
}

void LayersPanel::rebuildStrips (std::size_t layers)
{
    strips.clear();
    total.reset();
    if (! all.empty())
    {
        const auto hint = [this] (const juce::String& text) {
            if (onHint) onHint (text);
        };
        const auto select = [this] (const std::string& patch, graph::Id id) {
            if (onSelect) onSelect (patch, id);
        };
        const auto dragged = [this] (int layer, int x, bool let_go) { drag (layer, x, let_go); };
        const auto context = std::make_shared<const MixerContext> (MixerContext { document, catalogue, chosen, hint, select, dragged, completeRemoval });
        for (std::size_t i = 0; i < layers; ++i)
        {
            row.addAndMakeVisible (*strips.emplace_back (std::make_unique<LayerStrip> (context, static_cast<int> (i))));
            strips.back()->refresh (traces, 1e-3, false);   // what the trace of its port holds so far is of another layer
        }
        addAndMakeVisible (*(total = std::make_unique<MixStrip> (context)));
    }
    requestTraces();
}

void LayersPanel::rebuildUnmixed()
{
    auto now = all.empty() ? BehindMixer {} : behindMixer (document.graph(), chosen, catalogue);
    if (now == behind && now.unmixed.size() == past.size()) return;
    behind = std::move (now);
    past.clear();
    for (const auto& u : behind.unmixed)
        row.addAndMakeVisible (*past.emplace_back (std::make_unique<UnmixedStrip> (u, [this, u] { mixIn (u); })));
    requestTraces();
}

void LayersPanel::mixIn (const UnmixedSignal& u)
{
    if (! commandToMix) return;
    auto command = commandToMix (u);
    if (! command)
    {
        if (onHint) onHint (juce::String (messageText (command.error())));
        return;
    }
    // Asynchronous, because the command deletes the strip whose button is being clicked.
    juce::MessageManager::callAsync ([safe = juce::Component::SafePointer (this), edit = *std::move (command)] {
        if (safe != nullptr) safe->document.perform (edit);
    });
}

void LayersPanel::requestTraces()
{
    std::vector<std::string> levels, signals;
    if (! all.empty())   // peaks count while the panel is hidden, too
    {
        levels = { chosen.path + ".out", chosen.path + ".reduction" };
        std::ranges::copy (behind.motors, std::back_inserter (levels));
        for (const auto& u : behind.unmixed)
            levels.push_back (u.from);
        for (std::size_t i = 0; i < strips.size(); ++i)
        {
            levels.push_back (chosen.path + ".level[" + std::to_string (i) + ']');
            if (isVisible()) signals.push_back (chosen.path + ".in[" + std::to_string (i) + ']');
        }
    }
    traces.want (std::move (levels));
    spectra.want (std::move (signals));
}

void LayersPanel::visibilityChanged()
{
    requestTraces();
    if (! isVisible()) return;
    proposeMixer();
    resized();
}

void LayersPanel::refresh()
{
    const double now = juce::Time::getMillisecondCounterHiRes();
    const double dt = std::clamp ((now - refreshed_ms) * 1e-3, 1e-3, 1.0);
    refreshed_ms = now;
    const bool with_spectrum = isVisible() && ++refreshes % spectrum_every == 0;
    for (auto& s : strips)
        s->refresh (traces, dt, with_spectrum);
    for (auto& s : past)
        s->refresh (traces, dt);
    if (total) total->refresh (traces, behind.motors, dt);
}

void LayersPanel::choose (std::size_t mixer)
{
    if (mixer >= all.size()) return;
    // Asynchronous, because the rebuild deletes the button that was clicked.
    juce::MessageManager::callAsync ([safe = juce::Component::SafePointer (this), id = all[mixer].id] {
        if (safe == nullptr) return;
        const auto at = std::ranges::find (safe->all, id, &MixerPlace::id);
        if (at == safe->all.end()) return;
        safe->chosen = {};
        safe->chosen.id = id;
        safe->rebuild();
    });
}

void LayersPanel::begin (const std::string& type)
{
    if (type != clip_type || ! onChooseClip) return add (type);
    onChooseClip ([safe = juce::Component::SafePointer (this), type] (const std::filesystem::path& file) {
        if (safe != nullptr) safe->add (type, file);
    });
}

void LayersPanel::add (const std::string& type, const std::filesystem::path& clip)
{
    graph::Batch batch { NEEDS_TRANS ("add a layer"), {} };
    auto place = chosen;
    auto graph = document.graph();
    const auto refuse = [this] (const Message& why) {
        if (onHint) onHint (juce::String (messageText (why)));
    };
    if (all.empty())
    {
        auto mixer = addMixer (graph, catalogue);
        if (! mixer) return refuse (mixer.error());
        if (const auto applied = graph::apply (graph, mixer->command); ! applied) return refuse (applied.error());
        place = mixer->place;
        batch.commands.push_back (std::move (mixer->command));
    }
    auto added = addLayer (graph, place, catalogue, type, clip.empty() ? std::string() : pathFrom (clip, graph.folder));
    if (! added) return refuse (added.error());
    if (const auto* named = std::get_if<graph::Batch> (&added->command.edit)) batch.name = named->name;
    batch.commands.push_back (std::move (added->command));
    chosen = place;
    if (! document.perform (std::move (batch))) return;
    if (added->node != 0 && onAdded) onAdded (place.patch, added->node);
    if (onHint && ! added->missing.empty()) onHint (juce::String (added->missing));
    showNewest();
}

/// Scrolls so that the last layer is in view, and the unmixed signals behind it.
void LayersPanel::showNewest()
{
    const int hidden = std::max (0, static_cast<int> (strips.size()) * strip_width - scroll.getViewWidth());
    scroll.setViewPosition ((hidden + strip_width - 1) / strip_width * strip_width, scroll.getViewPositionY());
}

void LayersPanel::addMixerNow()
{
    if (auto added = addMixer (document.graph(), catalogue))
        juce::MessageManager::callAsync ([safe = juce::Component::SafePointer (this), command = std::move (added->command)] {
            if (safe != nullptr) safe->document.perform (command);
        });
}

void LayersPanel::addClip (const std::filesystem::path& file, std::optional<double> gain)
{
    const auto say = [this] (const juce::String& text) {
        if (onHint) onHint (text);
    };
    const auto& graph = document.graph();
    graph::Batch batch { NEEDS_TRANS ("add a clip as a layer"), {} };
    auto with_mixer = graph;
    auto place = chosen;
    if (all.empty())
    {
        auto mixer = addMixer (graph, catalogue);
        if (! mixer) return say (juce::String (messageText (mixer.error())));
        if (! graph::apply (with_mixer, mixer->command)) return;
        const auto made = mixersOf (with_mixer);
        if (made.empty()) return;
        place = made.front();
        batch.commands.push_back (std::move (mixer->command));
    }
    auto layer = addClipLayer (with_mixer, place, catalogue, pathFrom (file, graph.folder), gain);
    if (! layer) return say (juce::String (messageText (layer.error())));
    batch.commands.push_back (std::move (layer->command));
    if (! document.perform (std::move (batch))) return;
    say (filled (TRANS ("%1 is a layer now. It plays over and over."), printableName (file.filename().string())));
    showNewest();
}

bool LayersPanel::isInterestedInFileDrag (const juce::StringArray& files)
{
    const std::filesystem::path file { files.size() == 1 ? files[0].toStdString() : std::string() };
    return isClipExtension (file) || extensionOf (file) == ".json";
}

void LayersPanel::showDrop (const juce::String& hint)
{
    file_over = true;
    if (onHint) onHint (hint);
    repaint();
}

void LayersPanel::endDrop()
{
    file_over = false;
    if (onHint) onHint ({});
    repaint();
}

void LayersPanel::fileDragEnter (const juce::StringArray&, int, int) { showDrop (TRANS ("Drop the clip to add a layer that plays it.")); }

void LayersPanel::fileDragExit (const juce::StringArray&) { endDrop(); }

void LayersPanel::filesDropped (const juce::StringArray& files, int, int)
{
    fileDragExit (files);
    const std::filesystem::path file { files[0].toStdString() };
    if (isClipFile (file)) return addClip (file);
    if (onHint) onHint (filled (TRANS ("%1 is not a clip."), printableName (file.filename().string())));
}

bool LayersPanel::isInterestedInDragSource (const SourceDetails& dragged)
{
    return onPresetDropped && ! fileOfDragged (dragged.description.toString().toStdString()).empty();
}

void LayersPanel::itemDropped (const SourceDetails& dragged)
{
    endDrop();
    onPresetDropped (fileOfDragged (dragged.description.toString().toStdString()));
}

void LayersPanel::openMenu()
{
    juce::PopupMenu menu;
    std::vector<std::string> types { "" };
    menu.addItem (1, TRANS ("Empty layer"));
    std::string family;
    for (const auto* t : layerTypes (catalogue, chosen.vectors))
    {
        const std::string id (t->info.id), of = id.substr (0, id.find ('.'));
        if (of != family) menu.addSectionHeader (headingOf (of));
        family = of;
        types.push_back (id);
        menu.addItem (static_cast<int> (types.size()), std::string (t->info.name));
    }
    menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (more), [safe = juce::Component::SafePointer (this), types] (int chosen_item) {
        if (safe != nullptr && chosen_item > 0) safe->begin (types[static_cast<std::size_t> (chosen_item - 1)]);
    });
}

void LayersPanel::drag (int layer, int x, bool let_go)
{
    const int to = std::clamp ((x + strip_width / 2) / strip_width, 0, static_cast<int> (strips.size()));
    drop_at = let_go ? -1 : to;
    repaint();
    const int place = to > layer ? to - 1 : to;
    if (! let_go || place == layer) return;
    juce::MessageManager::callAsync ([safe = juce::Component::SafePointer (this), layer, place] {
        if (safe == nullptr) return;
        const auto& graph = safe->document.graph();
        if (findMixer (graph, safe->chosen) != nullptr) safe->document.perform (moveLayer (graph, safe->chosen, safe->catalogue, layer, place));
    });
}

bool LayersPanel::keyPressed (const juce::KeyPress& key)
{
    const bool to_left = key.isKeyCode (juce::KeyPress::leftKey);
    const auto* part = getCurrentlyFocusedComponent();
    if (! key.getModifiers().isCtrlDown() || ! (to_left || key.isKeyCode (juce::KeyPress::rightKey)) || part == nullptr) return false;
    const auto own = std::ranges::find (strips, part->getParentComponent(), [] (const auto& s) { return s.get(); });
    const bool is_mix = total != nullptr && part->getParentComponent() == total.get();
    if (own == strips.end() && ! is_mix) return false;
    const auto beside = own - strips.begin() + (to_left ? -1 : 1);
    if (total != nullptr && beside == std::ssize (strips)) takeFocus (*total->fields().back());
    if (beside < 0 || beside >= std::ssize (strips)) return true;
    if (is_mix) return takeFocus (strips.back()->gainField()), true;
    auto& strip = *strips[static_cast<std::size_t> (beside)];
    auto* to = strip.getChildComponent ((*own)->getIndexOfChildComponent (part));
    if (to == nullptr || ! to->isShowing() || ! to->isEnabled()) return true;
    scroll.setViewPosition (std::min (std::max (scroll.getViewPositionX(), strip.getRight() - scroll.getViewWidth()), strip.getX()), 0);
    takeFocus (*to);
    return true;
}

void LayersPanel::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.fillAll (theme.panel);
    if (all.empty())
    {
        introductionText (introduction_parts).draw (g, introductionArea().toFloat());
        return;
    }
    if (scroll.getX() == 0) return;   // the head is behind the strips
    g.setColour (theme.hairline);
    g.drawVerticalLine (head_width - 1, 0.0f, static_cast<float> (getHeight()));
    g.setFont (look.font (12.0f));
    g.setColour (theme.dim);
    g.drawText (all.size() > 1 ? TRANS ("Mixers") : TRANS ("Mixer"), juce::Rectangle<int> (12, 4, head_width - 24, 24), juce::Justification::centredLeft,
                false);
}

void LayersPanel::paintOverChildren (juce::Graphics& g)
{
    if (file_over)
    {
        g.setColour (themeOf (*this).accent);
        g.drawRect (getLocalBounds(), 2);
    }
    if (drop_at < 0) return;
    g.setColour (themeOf (*this).accent);
    g.fillRect (scroll.getX() + drop_at * strip_width - scroll.getViewPositionX() - 1, 0, 2, getHeight());
}

void LayersPanel::layOutHead (juce::Rectangle<int> head)
{
    head.removeFromTop (24);
    auto buttons = head.removeFromBottom (3 * button_line);
    more.setBounds (buttons.removeFromBottom (button_line).withTrimmedTop (2));
    for (std::size_t i = 0; i < kinds.size(); i += 2)
    {
        auto pair = buttons.removeFromTop (button_line).withTrimmedTop (2);
        kinds[i]->setBounds (pair.removeFromLeft (pair.getWidth() / 2).withTrimmedRight (1));
        if (i + 1 < kinds.size()) kinds[i + 1]->setBounds (pair.withTrimmedLeft (1));
    }
    for (auto& n : names)
        n->setBounds (head.removeFromTop (26).withTrimmedBottom (2));
}

juce::Rectangle<int> LayersPanel::introductionArea() const
{
    const auto area = getLocalBounds().reduced (24, 16);
    return area.withWidth (std::min (area.getWidth(), 560));
}

juce::AttributedString LayersPanel::introductionText (int parts) const
{
    const auto& look = lookOf (*this);
    juce::AttributedString text;
    text.setWordWrap (juce::AttributedString::byWord);
    if (parts > 0) text.append (TRANS ("No layer mixer in this graph") + "\n", look.font (14.0f, true), look.theme().text);
    if (parts > 2) text.append (juce::translate (introduction) + "\n\n", look.font (13.0f), look.theme().dim);
    if (parts > 1) text.append (preview, look.font (13.0f), look.theme().text);
    return text;
}

/// As much of the text as leaves room for all buttons, and the buttons below it, in as many lines as they need.
void LayersPanel::layOutIntroduction()
{
    constexpr int gap = 4;
    placeIn (*this, kinds);
    const auto area = introductionArea();
    const auto placeButtons = [&] (int top) {
        juce::Point<int> at { area.getX(), top };
        const auto put = [&] (ToolButton& b) {
            if (! b.isVisible()) return;
            if (at.x > area.getX() && at.x + b.bestWidth() > getWidth() - area.getX()) at = { area.getX(), at.y + button_line + gap };
            b.setBounds (at.x, at.y, b.bestWidth(), button_line);
            at.x += b.bestWidth() + gap;
        };
        put (first);
        for (auto& b : kinds)
            put (*b);
        return at.y + button_line;
    };
    for (introduction_parts = 3; introduction_parts > 0; --introduction_parts)
    {
        juce::TextLayout text;
        text.createLayout (introductionText (introduction_parts), static_cast<float> (area.getWidth()));
        if (placeButtons (area.getY() + static_cast<int> (std::ceil (text.getHeight())) + 12) <= getHeight() - gap) return;
    }
    placeButtons (gap);
}

void LayersPanel::resized()
{
    if (all.empty()) return layOutIntroduction();
    auto area = getLocalBounds();
    const bool is_narrow = area.getWidth() < head_width + LayerStrip::width + MixStrip::width;
    auto& parent = is_narrow ? row : static_cast<juce::Component&> (*this);
    placeIn (parent, names);
    placeIn (parent, kinds);
    placeIn (parent, { &more, total.get() });
    const int bar = scroll.getScrollBarThickness(), count = static_cast<int> (strips.size() + past.size());
    const int room = (area.getWidth() - head_width - MixStrip::width) / std::max (count, 1);
    strip_width = std::clamp (room, LayerStrip::width, LayerStrip::widest);
    const int all_strips = count * strip_width;
    if (is_narrow)   // the strips, the mix and the head scroll together
    {
        scroll.setBounds (area);
        row.setSize (all_strips + MixStrip::width + head_width, std::max (LayerStrip::least_height, area.getHeight() - bar));
        placeStrips();
        if (total) total->setBounds (all_strips, 0, MixStrip::width, row.getHeight());
        return layOutHead ({ all_strips + MixStrip::width + 12, 4, head_width - 24, row.getHeight() - 8 });
    }
    layOutHead (area.removeFromLeft (head_width).reduced (12, 4));
    if (total) total->setBounds (area.removeFromRight (MixStrip::width));
    scroll.setBounds (area);
    const int width = all_strips;
    const auto size = sizeInView (area, { width, LayerStrip::least_height }, bar);
    // The row is so wide that, scrolled to its end, the first strip in view is whole.
    const int hidden = std::max (0, width - size.seen_width), whole = (hidden + strip_width - 1) / strip_width * strip_width;
    row.setSize (hidden == 0 ? width : whole + size.seen_width, size.height);
    placeStrips();
}

void LayersPanel::placeStrips()
{
    int x = 0;
    const auto place = [&] (juce::Component& strip) {
        strip.setBounds (x, 0, strip_width, row.getHeight());
        x += strip_width;
    };
    for (auto& s : strips)
        place (*s);
    for (auto& s : past)
        place (*s);
}

}   // namespace tactus::host
