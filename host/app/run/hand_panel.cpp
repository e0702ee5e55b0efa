// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_panel.hpp"

#include <host/devices/gestures.hpp>

namespace tactus::host
{

namespace
{
constexpr int as_described = 1, by_pointer = 2, by_recording = 3, first_gesture = 10;
constexpr int row_height = 32, margin = 8;
}   // namespace

/// A triangle while it stands, two bars while it plays.
class HandPanel::PlayButton final : public juce::Button
{
public:
    PlayButton() : Button ("Play")
    {
        setClickingTogglesState (true);
        setTooltip ("Plays or stops the gesture. The hand stays where it is.");
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

/// A loudspeaker, with waves while it sounds.
class HandPanel::SoundButton final : public juce::Button
{
public:
    SoundButton() : Button ("Sound") { setTooltip ("Lets the force be heard through the sound card."); }

    void paintButton (juce::Graphics& g, bool over, bool) override
    {
        const auto& theme = themeOf (*this);
        const auto at = getLocalBounds().toFloat().getCentre();
        juce::Path p;
        p.addRectangle (at.x - 8.0f, at.y - 3.0f, 4.0f, 6.0f);
        p.addTriangle (at.x - 5.0f, at.y, at.x + 1.0f, at.y - 7.0f, at.x + 1.0f, at.y + 7.0f);
        g.setColour (getToggleState() ? theme.accent : over ? theme.text
                                                            : theme.dim);
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

HandPanel::HandPanel (Sound& s) : sound (s), play (std::make_unique<PlayButton>()), listen (std::make_unique<SoundButton>())
{
    who.addItem ("Its own device", as_described);
    who.addItem ("Mouse or pen", by_pointer);
    who.addSeparator();
    int id = first_gesture;
    for (const auto& gesture : gestures())
        who.addItem ("Gesture: " + juce::String (std::string (gesture.id)), id++);
    who.setSelectedId (as_described, juce::dontSendNotification);
    who.setTooltip ("Who moves the tool. Its own device is what the Devices panel binds it to, or what the graph says. A recording (CSV with t,x,y,z) can be dropped here.");
    who.onChange = [this]
    { choose(); };

    play->onClick = [this]
    {
        if (transport != nullptr) transport->play (play->getToggleState());
    };
    position.setSliderStyle (juce::Slider::LinearBar);
    position.setNumDecimalPlacesToDisplay (2);
    position.setTextValueSuffix (" s");
    position.setTooltip ("Where in the gesture the hand is. Drag to go elsewhere.");
    position.onValueChange = [this]
    {
        if (transport != nullptr) transport->seek (position.getValue());
    };
    speed.setSliderStyle (juce::Slider::LinearBar);
    speed.setRange (TransportPath::least_speed, TransportPath::most_speed);
    speed.setSkewFactorFromMidPoint (1.0);
    speed.setNumDecimalPlacesToDisplay (2);
    speed.setTextValueSuffix (" x");
    speed.setValue (1.0, juce::dontSendNotification);
    speed.setDoubleClickReturnValue (true, 1.0);
    speed.setTooltip ("How fast it is played. A double click brings 1 x back.");
    speed.onValueChange = [this]
    {
        if (transport != nullptr) transport->setSpeed (speed.getValue());
    };
    listen->onClick = [this]
    {
        if (sound.isOn())
            sound.stop();
        else if (const auto problem = sound.start(); problem && onHint)
            onHint ("No sound: " + juce::String::fromUTF8 ((problem->text + "; " + problem->remedy).c_str()));
    };
    addAndMakeVisible (surface);
    addAndMakeVisible (who);
    addAndMakeVisible (*listen);
    for (auto* c : std::initializer_list<juce::Component*> { play.get(), &position, &speed })
        addChildComponent (c);
}

void HandPanel::choose()
{
    if (! onHand) return;
    const int id = who.getSelectedId();
    if (id == as_described) onHand ({});
    if (id == by_pointer) onHand (Performance::Hand::pointer());
    if (const auto i = id - first_gesture; i >= 0 && i < static_cast<int> (gestures().size())) onHand ({ Performance::Hand::Kind::path, std::string (gestures()[static_cast<std::size_t> (i)].id) });
}

void HandPanel::show (Performance& p)
{
    using Kind = Performance::Hand::Kind;
    surface.show (p);
    listen->setToggleState (sound.isOn(), juce::dontSendNotification);
    const auto& hand = p.hand();
    int id = hand.kind == Kind::described ? as_described : hand.kind == Kind::pointer ? by_pointer
                                                                                      : by_recording;
    for (std::size_t i = 0; i < gestures().size(); ++i)
        if (hand.kind == Kind::path && gestures()[i].id == hand.path) id = first_gesture + static_cast<int> (i);
    if (id == by_recording)
    {
        const auto name = "Recording: " + juce::File (hand.path).getFileName();
        who.indexOfItemId (by_recording) < 0 ? who.addItem (name, by_recording) : who.changeItemText (by_recording, name);
    }
    if (who.getSelectedId() != id) who.setSelectedId (id, juce::dontSendNotification);

    const auto now = p.isRunning() ? p.transport() : nullptr;
    const bool is_new = now != transport;
    transport = now;
    for (auto* c : std::initializer_list<juce::Component*> { play.get(), &position, &speed })
        c->setVisible (transport != nullptr);
    auto words = ! p.isRunning() ? juce::String ("Nothing runs. START is at the top right.") : hand.kind == Kind::pointer ? (surface.isHeld() ? "Held " : "Press and drag: ") + juce::String (1000.0 * surface.depth(), 1) + (surface.isHeld() ? " mm deep; H lets go" : " mm deep (wheel); H holds")
                                                                                                                          : juce::String ("The tool follows its device.");
    if (words != note)
    {
        note = std::move (words);
        repaint();
    }
    if (transport == nullptr) return;
    if (is_new)
    {
        const double lasts = transport->duration();
        position.setRange (0.0, lasts > 0.0 ? lasts : 1.0);
        transport->setSpeed (speed.getValue());
    }
    play->setToggleState (transport->isPlaying(), juce::dontSendNotification);
    if (! position.isMouseButtonDown()) position.setValue (transport->position(), juce::dontSendNotification);
}

bool HandPanel::isInterestedInFileDrag (const juce::StringArray& files) { return files.size() == 1 && files[0].endsWithIgnoreCase (".csv"); }

void HandPanel::filesDropped (const juce::StringArray& files, int, int)
{
    if (onHand) onHand ({ Performance::Hand::Kind::path, files[0].toStdString() });
}

void HandPanel::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.fillAll (look.theme().panel);
    g.setFont (look.font (13.0f, true));
    g.setColour (look.theme().text);
    g.drawText ("The hand", getLocalBounds().removeFromTop (row_height).withTrimmedLeft (16), juce::Justification::centredLeft, false);
    if (transport != nullptr) return;
    g.setFont (look.font (12.0f));
    g.setColour (look.theme().dim);
    g.drawText (note, getLocalBounds().removeFromBottom (row_height).reduced (margin, 0), juce::Justification::centredLeft, true);
}

void HandPanel::resized()
{
    auto area = getLocalBounds();
    auto head = area.removeFromTop (row_height).reduced (margin, 4);
    listen->setBounds (head.removeFromRight (28));
    who.setBounds (head.removeFromRight (std::min (200, head.getWidth() - 80)));
    auto low = area.removeFromBottom (row_height).reduced (margin, 4);
    play->setBounds (low.removeFromLeft (24));
    low.removeFromLeft (4);
    speed.setBounds (low.removeFromRight (72));
    low.removeFromRight (4);
    position.setBounds (low);
    surface.setBounds (area.reduced (margin, 0));
}

}   // namespace tactus::host
