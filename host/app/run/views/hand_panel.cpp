// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_panel.hpp"

#include <host/app/look/button.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/run/device/gestures.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr int as_described = 1, by_pointer = 2, by_recording = 3, first_gesture = 10;
constexpr int bar_height = 32, margin = 8, least_width_for_one_row = 360;
}   // namespace

/// A triangle while paused, two bars while playing.
class HandPanel::PlayButton final : public Button
{
public:
    PlayButton() : Button (TRANS ("Play"))
    {
        setClickingTogglesState (true);
        setTooltip (TRANS ("Plays or pauses the gesture. While paused, the hand stays where it is."));
    }

    void paintButton (juce::Graphics& g, bool over, bool) override
    {
        const auto& theme = themeOf (*this);
        const auto box = getLocalBounds().toFloat().withSizeKeepingCentre (12.0f, 12.0f);
        g.setColour (over ? theme.accent : theme.text);
        if (getToggleState())
        {
            g.fillRect (box.withWidth (4.0f));
            g.fillRect (box.withTrimmedLeft (8.0f));
            return;
        }
        juce::Path triangle;
        triangle.addTriangle (box.getTopLeft(), box.getBottomLeft(), { box.getRight(), box.getCentreY() });
        g.fillPath (triangle);
    }
};

/// A loudspeaker, with waves while it is on.
class HandPanel::SoundButton final : public Button
{
public:
    SoundButton() : Button (TRANS ("Sound")) { setTooltip (TRANS ("Plays the force through the sound card.")); }

    void paintButton (juce::Graphics& g, bool over, bool) override
    {
        const auto& theme = themeOf (*this);
        const auto at = getLocalBounds().toFloat().getCentre();
        juce::Path p;
        p.addRectangle (at.x - 8.0f, at.y - 3.0f, 4.0f, 6.0f);
        p.addTriangle (at.x - 5.0f, at.y, at.x + 1.0f, at.y - 7.0f, at.x + 1.0f, at.y + 7.0f);
        const auto off = over ? theme.text : theme.dim;
        g.setColour (getToggleState() ? theme.accent : off);
        g.fillPath (p);
        if (! getToggleState()) return;
        for (const float r : { 5.0f, 9.0f })
        {
            juce::Path wave;
            wave.addCentredArc (at.x, at.y, r, r, 0.0f, 0.9f, juce::MathConstants<float>::pi - 0.9f, true);
            g.strokePath (wave, juce::PathStrokeType (1.5f));
        }
    }
};

HandPanel::HandPanel (Playback& p, Sound& s) : playback (p), sound (s), play (std::make_unique<PlayButton>()), listen (std::make_unique<SoundButton>())
{
    setOpaque (true);
    setTitle (TRANS ("Hand"));
    source.setTitle (TRANS ("What moves the tool"));
    source.addItem (TRANS ("Its own device"), as_described);
    source.addItem (TRANS ("Mouse or pen"), by_pointer);
    source.addSeparator();
    int id = first_gesture;
    for (const auto& gesture : gestures())
        source.addItem (filled (TRANS ("Gesture: %1"), gesture.id), id++);
    source.setSelectedId (as_described, juce::dontSendNotification);
    shown_source = as_described;
    source.setTooltip (TRANS ("What moves the tool. Its own device is the one chosen in the Devices panel, or else the one described in the graph. "
                              "Drop a recording (CSV with t,x,y,z) here to play it: the tool goes where it was recorded, whatever the force. "
                              "A gesture is followed by a soft hand."));
    source.onChange = [this] { choose(); };
    tools.setTitle (TRANS ("Which tool the hand moves"));
    tools.setTooltip (TRANS ("Which tool the hand moves, such as a finger. The others are moved by their own devices, gestures or recordings."));
    tools.onChange = [this] {
        if (const auto i = tools.getSelectedItemIndex(); i >= 0) playback.moveTool (tool_roles[static_cast<std::size_t> (i)]);
    };

    play->onClick = [this] {
        if (transport != nullptr) transport->play (play->getToggleState());
    };
    position.setTitle (TRANS ("Position in the gesture"));
    speed.setTitle (TRANS ("Speed of the gesture"));
    position.setSliderStyle (juce::Slider::LinearBar);
    position.setNumDecimalPlacesToDisplay (2);
    position.setTextValueSuffix (" s");
    position.setTooltip (TRANS ("Position in the gesture. Drag to seek."));
    position.onValueChange = [this] {
        if (transport != nullptr) transport->seek (position.getValue());
    };
    speed.setSliderStyle (juce::Slider::LinearBar);
    speed.setSliderSnapsToMousePosition (false);   // a press leaves the speed
    speed.setRange (TransportPath::least_speed, TransportPath::most_speed);
    speed.setSkewFactorFromMidPoint (1.0);
    speed.setNumDecimalPlacesToDisplay (2);
    speed.setTextValueSuffix (" x");
    speed.setValue (1.0, juce::dontSendNotification);
    speed.setDoubleClickReturnValue (true, 1.0);
    speed.setTooltip (TRANS ("Playback speed. Double-click to reset to 1 x."));
    speed.onValueChange = [this] {
        if (transport != nullptr) transport->setSpeed (speed.getValue());
    };
    listen->onClick = [this] {
        if (sound.isOn())
            sound.stop();
        else if (const auto started = sound.start(); ! started && onHint)
            onHint (filled (TRANS ("No sound: %1"), messageText (started.error())));
    };
    connectScene();
    addAndMakeVisible (surface);
    addAndMakeVisible (source);
    addAndMakeVisible (*listen);
    addChildComponent (tools);
    for (auto* c : std::initializer_list<juce::Component*> { play.get(), &position, &speed })
        addChildComponent (c);
}

void HandPanel::connectScene()
{
    space.onSteer = [this] (double x, double y, bool presses) { surface.steer (x, y, presses); };
    space.onDeeper = [this] (double octaves) { surface.pressDeeper (octaves); };
    const auto choose = [this] (bool scene) {
        showScene (scene);
        if (onSceneToggled) onSceneToggled();
    };
    from_above.onClick = [choose] { choose (false); };
    in_space.onClick = [choose] { choose (true); };
    larger.onClick = [this] { enlarge (! is_large); };
    addChildComponent (space);
    addAndMakeVisible (film_button);
    film_button.onHint = [this] (const juce::String& text) {
        if (onHint) onHint (text);
    };
    for (auto* b : { &from_above, &in_space, &larger })
        addAndMakeVisible (*b);
    showScene (false);
}

void HandPanel::showScene (bool scene)
{
    is_scene = scene;
    if (! scene && is_large) enlarge (false);
    from_above.setToggleState (! is_scene, juce::dontSendNotification);
    in_space.setToggleState (is_scene, juce::dontSendNotification);
    space.setVisible (is_scene);
    watchScene();
    surface.setVisible (! is_scene || showsBoth());
    larger.setVisible (is_scene);
    resized();
    repaint();
}

void HandPanel::setSeen (bool seen)
{
    if (std::exchange (is_seen, seen) != seen) watchScene();
}

/// A film needs the scene even if it is not on the screen.
void HandPanel::watchScene()
{
    const bool watches = (is_scene && is_seen) || film_button.isFilming();
    if (std::exchange (is_watching, watches) != watches) space.watch (watches);
}

void HandPanel::enlarge (bool large)
{
    if (std::exchange (is_large, large) == large) return;
    larger.setToggleState (large, juce::dontSendNotification);
    if (onEnlarge) onEnlarge();
    showScene (is_scene);
}

void HandPanel::choose()
{
    const int id = source.getSelectedId();
    const bool is_choice = id != 0 && id != by_recording;
    shown_source = is_choice ? id : 0;   // else the next refresh would undo a second choice that is still on its way
    if (! is_choice) return;             // nothing changes
    chosen_hand = {};
    if (id == by_pointer) chosen_hand = LiveRun::Hand::pointer();
    if (id >= first_gesture) chosen_hand = { LiveRun::Hand::Kind::path, std::string (gestures()[static_cast<std::size_t> (id - first_gesture)].id) };
    playback.moveBy (chosen_hand);
}

std::vector<std::pair<juce::String, std::function<void()>>> HandPanel::choices()
{
    std::vector<std::pair<juce::String, std::function<void()>>> all;
    const auto add = [&all] (juce::ComboBox& list, const juce::String& name) {
        for (int i = 0; i < list.getNumItems(); ++i)
            all.emplace_back (filled (name, list.getItemText (i).replace (": ", " ")), [safe = SafePointer (&list), id = list.getItemId (i)] {
                if (safe != nullptr) safe->setSelectedId (id, juce::sendNotificationSync);
            });
    };
    add (source, TRANS ("Hand: %1"));
    if (tools.isVisible()) add (tools, TRANS ("The hand moves %1"));
    return all;
}

std::function<void()> HandPanel::useDevice()
{
    struct Hands
    {
        LiveRun::Hand moves, chosen;
    };
    const Hands before { playback.run().hand(), chosen_hand }, device {};
    const auto exchange = [safe = SafePointer (this), before, device, is_device = std::make_shared<bool> (false)] {
        const auto& from = *is_device ? device : before;
        const auto& to = *is_device ? before : device;
        *is_device = ! *is_device;
        if (safe == nullptr || safe->playback.run().hand() != from.moves) return;
        safe->chosen_hand = to.chosen;
        safe->playback.changeHand (to.moves);
    };
    exchange();
    return exchange;
}

void HandPanel::refresh()
{
    const auto& run = playback.current();
    surface.refresh();
    watchScene();
    space.refresh();
    film_button.refresh();
    if (film_button.leastWidth() != film_width) resized();
    listen->setToggleState (sound.isOn(), juce::dontSendNotification);
    showSource (run.hand());
    showTools();
    showTransport (run);
    if (auto text = noteFor (run); text != note)
    {
        note = std::move (text);
        repaint();
    }
}

void HandPanel::showSource (const LiveRun::Hand& hand)
{
    using Kind = LiveRun::Hand::Kind;
    int id = by_recording;
    if (hand.kind == Kind::described) id = as_described;
    if (hand.kind == Kind::pointer) id = by_pointer;
    for (std::size_t i = 0; i < gestures().size(); ++i)
        if (hand.kind == Kind::path && gestures()[i].id == hand.path) id = first_gesture + static_cast<int> (i);
    if (id == by_recording)
    {
        const auto name = filled (TRANS ("Recording: %1"), fromUtf8 (std::filesystem::path (hand.path).filename().string()));
        source.indexOfItemId (by_recording) < 0 ? source.addItem (name, by_recording) : source.changeItemText (by_recording, name);
    }
    if (std::exchange (shown_source, id) != id) source.setSelectedId (id, juce::dontSendNotification);   // what the user has just chosen arrives later
}

/// The list of tools is there only if there is a choice.
void HandPanel::showTools()
{
    const auto& run = playback.run();
    if (auto roles = run.toolRoles(); roles != tool_roles)
    {
        tool_roles = std::move (roles);
        tools.clear (juce::dontSendNotification);
        for (int id = 1; const auto& role : tool_roles)
            tools.addItem (fromUtf8 (role), id++);
        tools.setVisible (tool_roles.size() > 1);
        shown_tool.clear();
        resized();
        repaint();
    }
    // Only when it has changed: what the user has just chosen arrives later.
    if (const auto now = run.handRole(); now != std::exchange (shown_tool, now))
        tools.setSelectedItemIndex (static_cast<int> (std::ranges::find (tool_roles, now) - tool_roles.begin()), juce::dontSendNotification);
}

void HandPanel::showTransport (const LiveRun& run)
{
    const auto now = run.isRunning() ? run.transport() : nullptr;
    const bool is_new = now != transport;
    if ((now == nullptr) != (transport == nullptr)) repaint();   // the note appears or disappears, also between the controls
    transport = now;
    for (auto* c : std::initializer_list<juce::Component*> { play.get(), &position, &speed })
        c->setVisible (transport != nullptr);
    if (transport == nullptr) return;
    if (is_new)
    {
        const double length = transport->duration();
        position.setRange (0.0, length > 0.0 ? length : 1.0);
        transport->setSpeed (speed.getValue());
    }
    play->setToggleState (transport->isPlaying(), juce::dontSendNotification);
    if (! position.isMouseButtonDown()) position.setValue (transport->position(), juce::dontSendNotification);
}

juce::String HandPanel::noteFor (const LiveRun& run) const
{
    if (! run.isRunning() && run.edited().root.nodes.empty()) return TRANS ("Nothing to feel yet: choose a preset, or add a node.");
    if (run.isWaiting()) return TRANS ("Starts once the problems are solved: see Problems.");
    if (! run.isRunning()) return hasErrors (run.messages()) ? TRANS ("Cannot run: see Problems.") : TRANS ("Not running. Press START at the top right.");
    if (run.hand().kind != LiveRun::Hand::Kind::pointer)
        return is_scene ? TRANS ("Drag: turn. Shift+drag: move. Wheel: zoom.") : TRANS ("The tool follows its device.");
    if (is_scene && ! showsBoth()) return TRANS ("Drag the tool to press. Elsewhere: turn; Shift: move; wheel: zoom.");
    const auto text = surface.isHeld() ? TRANS ("Held at a depth of %1. H: release") : TRANS ("Press and drag. The wheel sets the depth: %1. H: hold");
    return filled (text, withPrefix (surface.depth(), "m", 2));
}

bool HandPanel::isInterestedInFileDrag (const juce::StringArray& files) { return files.size() == 1 && files[0].endsWithIgnoreCase (".csv"); }

void HandPanel::filesDropped (const juce::StringArray& files, int, int)
{
    chosen_hand = {};   // a recording belongs to this graph
    playback.moveBy ({ LiveRun::Hand::Kind::path, files[0].toStdString() });
}

void HandPanel::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.fillAll (look.theme().panel);
    g.setFont (look.font (13.0f, true));
    g.setColour (look.theme().text);
    g.drawText (TRANS ("Hand"), getLocalBounds().removeFromTop (bar_height).withTrimmedLeft (16), juce::Justification::centredLeft, false);
    if (transport != nullptr) return;
    g.setFont (look.font (12.0f));
    g.setColour (look.theme().dim);
    const int left = tools.isVisible() ? tools.getRight() : 0;
    g.drawFittedText (note, getLocalBounds().removeFromBottom (bar_height).withLeft (left).reduced (margin, 0), juce::Justification::centredLeft, 2, 1.0f);
}

/// The width at which each item of a list can be read, except the name of a recording.
int HandPanel::wantedWidth (const juce::ComboBox& list) const
{
    constexpr int around_text = 32;   // the border and the arrow
    const auto font = lookOf (*this).font (12.0f);
    float widest = 0.0f;
    for (int i = 0; i < list.getNumItems(); ++i)
        if (list.getItemId (i) != by_recording || &list != &source) widest = std::max (widest, font.getStringWidthFloat (list.getItemText (i)));
    return static_cast<int> (std::ceil (widest)) + around_text;
}

void HandPanel::resized()
{
    auto area = getLocalBounds();
    auto head = area.removeFromTop (bar_height).reduced (margin, 4);
    listen->setBounds (head.removeFromRight (28));
    head.removeFromLeft (52);   // the title
    for (auto* b : { &from_above, &in_space, &larger })
    {
        if (! b->isVisible()) continue;
        b->setBounds (head.removeFromLeft (b->wantedWidth()));
        head.removeFromLeft (b == &in_space ? 8 : 2);
    }
    film_width = film_button.leastWidth();
    const bool is_narrow = getWidth() < least_width_for_one_row;
    const int room_for_film = is_narrow ? head.getWidth() : head.getWidth() - 6 - wantedWidth (source);
    film_button.setBounds (head.removeFromLeft (std::clamp (room_for_film, film_width, std::max (film_width, film_button.wantedWidth()))));
    head.removeFromLeft (2);
    if (is_narrow)
        source.setBounds (area.removeFromTop (bar_height).reduced (margin, 2));
    else
        source.setBounds (head.removeFromRight (std::min (std::max (200, wantedWidth (source)), head.getWidth() - 4)));
    auto low = area.removeFromBottom (bar_height).reduced (margin, 4);
    if (tools.isVisible())
    {
        tools.setBounds (low.removeFromLeft (std::min (wantedWidth (tools), low.getWidth() / 3)));
        low.removeFromLeft (4);
    }
    play->setBounds (low.removeFromLeft (24));
    low.removeFromLeft (4);
    speed.setBounds (low.removeFromRight (72));
    speed.setMouseDragSensitivity (std::max (1, speed.getWidth()));
    low.removeFromRight (4);
    position.setBounds (low);
    area.reduce (margin, 0);
    surface.setVisible (! is_scene || showsBoth());
    if (is_scene && showsBoth())
    {
        surface.setBounds (area.removeFromLeft (area.getWidth() * 2 / 5));
        area.removeFromLeft (margin);
    }
    else
        surface.setBounds (area);
    space.setBounds (area);
}

}   // namespace tactus::host
