// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "window_parts.hpp"

#include <functional>
#include <vector>

namespace tactus::host
{

/// The keyboard of a window: what its keys do, that a stop works whatever has the focus, and that the focus is never lost. [main thread]
class Keyboard final : private juce::FocusChangeListener, private juce::KeyListener
{
public:
    explicit Keyboard (WindowParts&);
    ~Keyboard() override;

    /// A key that no component has taken.
    bool press (const juce::KeyPress&);

    /// Some key has come up.
    void release() noexcept { clutch_ends = true; }

    /// Call many times a second: after a menu, a dialog, a field or a start, JUCE leaves the keyboard with nothing, or with a part of the window that has no
    /// keys.
    void poll();

    /// The component that has the keyboard unless the user has given it to another one.
    juce::Component& home();

    /// True if Esc stops the forces. If not, it closes something first.
    bool escStops() const;

    /// Call when the mouse is pressed on a component: applies what is typed elsewhere before a button acts, because a button may undo, store a snapshot or
    /// make a file.
    void pressed (const juce::Component&);

    /// A key of the window, as juce::KeyPress::createFromDescription() reads it, and what it does. The keys of panels come before these.
    struct Key
    {
        const char* key;
        std::function<void()> act;
    };
    std::vector<Key> keys;

private:
    void globalFocusChanged (juce::Component*) override;
    bool keyPressed (const juce::KeyPress&, juce::Component*) override;
    bool isAnythingOpen() const;
    bool stopsBy (const juce::KeyPress&);
    void escape (const juce::KeyPress&);
    bool act (const juce::KeyPress&);
    bool isForClutch() const;
    bool pressClutch (const juce::KeyPress&);
    void pollClutch();
    void endDrag();

    WindowParts& parts;
    juce::Component::SafePointer<juce::Component> focused;   // the component with the focus, whose keys are listened to
    bool holds_clutch = false, clutch_ends = false;          // the key of the clutch is down; some key has come up since it was pressed
};

}   // namespace tactus::host
