// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host::test
{

/// A window on a virtual screen, with a simulated mouse and keyboard. Their events take the same path as in a real window:
/// through focus, hovering, menus and any component in front of the target.
class Stage final : public juce::Component, public juce::DragAndDropContainer
{
public:
    Stage (int width, int height)
    {
        setOpaque (true);
        setWantsKeyboardFocus (true);   // as the windows of JUCE, which do not hand keys down
        setSize (width, height);
        setVisible (true);
        plugIn();
        addToDesktop (0);
    }

    ~Stage() override { removeFromDesktop(); }

    void paint (juce::Graphics& g) override { g.fillAll (juce::Colours::black); }

    std::function<bool (const juce::KeyPress&)> onKey;   ///< receives a key that nothing on the screen takes
    bool keyPressed (const juce::KeyPress& k) override { return onKey && onKey (k); }

    /// Adds a virtual screen, which menus need for their layout. JUCE drops it when the global scale changes.
    static void plugIn()
    {
        auto& all = const_cast<juce::Array<juce::Displays::Display>&> (juce::Desktop::getInstance().getDisplays().displays);
        if (! all.isEmpty()) return;
        juce::Displays::Display screen {};
        screen.isMain = true;
        screen.totalArea = screen.userArea = { 0, 0, 1920, 1080 };
        screen.scale = 1.0;
        screen.dpi = 96.0;
        all.add (screen);
    }

    void resized() override
    {
        for (auto* child : getChildren())
            if (child->getProperties().contains ("fills")) child->setBounds (getLocalBounds());
    }

    void fill (juce::Component& c)
    {
        c.getProperties().set ("fills", true);
        addAndMakeVisible (c);
        c.setBounds (getLocalBounds());
    }

    /// Positions are relative to this window.
    void move (juce::Point<float> to)
    {
        at = to;
        send (8);
    }

    void press (int button = juce::ModifierKeys::leftButtonModifier, int keys = 0)
    {
        held = keys;
        move (at);
        down = button;
        send (200);
    }

    /// The button stays down for a second.
    void hold() { later (1000); }

    void release()
    {
        down = 0;
        send (30);
        held = 0;
        send (1);
    }

    void click (juce::Point<float> to, int button = juce::ModifierKeys::leftButtonModifier, int keys = 0)
    {
        later (1000);   // so that it is not a double-click
        move (to);
        press (button, keys);
        release();
    }

    void doubleClick (juce::Point<float> to)
    {
        click (to);
        down = juce::ModifierKeys::leftButtonModifier;
        send (60);
        release();
    }

    void drag (juce::Point<float> from, juce::Point<float> to, int button = juce::ModifierKeys::leftButtonModifier, int keys = 0)
    {
        later (1000);
        move (from);
        press (button, keys);
        for (const float part : { 0.1f, 0.4f, 0.8f, 1.0f })
            move (from + (to - from) * part);
        release();
    }

    void wheel (juce::Point<float> to, float up, bool is_smooth, int keys = 0)
    {
        move (to);
        held = keys;
        juce::MouseWheelDetails turned {};
        turned.deltaY = up;
        turned.isSmooth = is_smooth;
        modifiersNow();
        if (auto* peer = getPeer()) peer->handleMouseWheel (juce::MouseInputSource::mouse, inPeer(), time, turned);
        held = 0;
        send (1);
    }

    void key (const juce::KeyPress& k)
    {
        juce::ModifierKeys::currentModifiers = k.getModifiers();
        if (auto* peer = getPeer()) peer->handleKeyPress (k);
        modifiersNow();
    }

    /// A key comes up. The system does not say which.
    void keyUp()
    {
        if (auto* peer = getPeer()) peer->handleKeyUpOrDown (false);
    }

    /// The key as described by juce::KeyPress.
    void key (const juce::String& described)
    {
        const auto k = juce::KeyPress::createFromDescription (described);
        const auto code = k.getKeyCode();
        const bool is_printable = ! k.getModifiers().isCtrlDown() && ! k.getModifiers().isAltDown() && code >= ' ' && code < 127;
        const auto character = is_printable ? juce::CharacterFunctions::toLowerCase (static_cast<juce::juce_wchar> (code)) : 0;
        key (juce::KeyPress (code, k.getModifiers(), character));
    }

    void type (const juce::String& text)
    {
        for (auto c = text.getCharPointer(); ! c.isEmpty(); ++c)
            key (juce::KeyPress (static_cast<int> (*c), {}, *c));
    }

    /// Another program gets the keyboard, as by Alt+Tab.
    void loseKeyboard() { static_cast<Peer*> (getPeer())->loseFocus(); }
    /// The window has it again.
    void regainKeyboard() { getPeer()->grabFocus(); }
    bool hasKeyboard() const { return getPeer()->isFocused(); }

    /// What is on the screen: like a window manager, it repaints only the places that asked for it.
    const juce::Image& screen()
    {
        auto* peer = static_cast<Peer*> (getPeer());
        if (shown.getBounds() != getLocalBounds())   // a new window is painted as a whole
        {
            shown = juce::Image (juce::Image::ARGB, getWidth(), getHeight(), true, juce::SoftwareImageType());
            peer->stale = getLocalBounds();
        }
        const auto stale = std::exchange (peer->stale, {});
        if (! stale.isEmpty()) paintInto (shown, stale);
        return shown;
    }

    /// What should be on the screen.
    juce::Image painted()
    {
        juce::Image all (juce::Image::ARGB, getWidth(), getHeight(), true, juce::SoftwareImageType());
        paintInto (all, getLocalBounds());
        return all;
    }

    void drop (const juce::String& file, juce::Point<float> to)
    {
        auto* peer = getPeer();
        if (peer == nullptr) return;
        at = to;
        const juce::ComponentPeer::DragInfo dragged { { file }, {}, inPeer().roundToInt() };
        peer->handleDragMove (dragged);
        peer->handleDragDrop (dragged);
    }

private:
    class Peer final : public juce::ComponentPeer
    {
    public:
        using ComponentPeer::ComponentPeer;

        void* getNativeHandle() const override { return const_cast<Peer*> (this); }   // unknown to the X server, if there is one
        void setVisible (bool) override {}
        void setTitle (const juce::String&) override {}
        void setBounds (const juce::Rectangle<int>& b, bool) override
        {
            bounds = b;
            handleMovedOrResized();
        }
        juce::Rectangle<int> getBounds() const override { return bounds; }
        juce::Point<float> localToGlobal (juce::Point<float> p) override { return p + bounds.getPosition().toFloat(); }
        juce::Point<float> globalToLocal (juce::Point<float> p) override { return p - bounds.getPosition().toFloat(); }
        using ComponentPeer::globalToLocal;
        using ComponentPeer::localToGlobal;
        void setMinimised (bool) override {}
        bool isMinimised() const override { return false; }
        void setFullScreen (bool) override {}
        bool isFullScreen() const override { return false; }
        void setIcon (const juce::Image&) override {}
        bool contains (juce::Point<int> p, bool) const override { return bounds.withZeroOrigin().contains (p); }
        OptionalBorderSize getFrameSizeIfPresent() const override { return {}; }
        juce::BorderSize<int> getFrameSize() const override { return {}; }
        bool setAlwaysOnTop (bool) override { return true; }
        void toFront (bool takes_focus) override
        {
            if (takes_focus) grabFocus();
        }
        void toBehind (ComponentPeer*) override {}
        bool isFocused() const override { return has_focus; }
        void grabFocus() override
        {
            if (std::exchange (has_focus, true)) return;
            handleFocusGain();
        }
        void loseFocus()
        {
            if (std::exchange (has_focus, false)) handleFocusLoss();
        }
        void repaint (const juce::Rectangle<int>& area) override { stale.add (area); }
        void performAnyPendingRepaintsNow() override {}
        void setAlpha (float) override {}
        juce::StringArray getAvailableRenderingEngines() override { return { "None" }; }
        void textInputRequired (juce::Point<int>, juce::TextInputTarget&) override {}

        juce::RectangleList<int> stale;   // what asked to be painted

    private:
        juce::Rectangle<int> bounds;
        bool has_focus = false;
    };

    juce::ComponentPeer* createNewPeer (int style, void*) override { return new Peer (*this, style); }

    void paintInto (juce::Image& image, const juce::RectangleList<int>& area)
    {
        auto clip = area;
        clip.clipTo (image.getBounds());
        juce::LowLevelGraphicsSoftwareRenderer context (image, {}, clip);
        getPeer()->handlePaint (context);
    }

    juce::Point<float> inPeer() const { return at * getDesktopScaleFactor(); }
    void modifiersNow() const { juce::ModifierKeys::currentModifiers = juce::ModifierKeys (held | down); }
    void later (juce::int64 ms) { time += ms; }

    void send (juce::int64 after_ms)
    {
        later (after_ms);
        modifiersNow();
        using Source = juce::MouseInputSource;
        auto* peer = getPeer();
        if (peer == nullptr) return;
        peer->handleMouseEvent (Source::mouse, inPeer(), juce::ModifierKeys (held | down), Source::defaultPressure, Source::defaultOrientation, time);
    }

    juce::Point<float> at;
    int down = 0, held = 0;
    juce::Image shown;
    juce::int64 time = juce::Time::currentTimeMillis();
};

}   // namespace tactus::host::test
