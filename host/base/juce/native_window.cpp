// SPDX-License-Identifier: GPL-3.0-or-later
// The module of JUCE for windows, compiled together with what needs its private parts: the class of a native window, and the
// functions of X11 that it calls, are known only inside of this module.
#include <juce_gui_basics/juce_gui_basics.cpp>

#include "native_window.hpp"

#include <utility>

namespace tactus::host
{

#if JUCE_LINUX && JUCE_MAJOR_VERSION == 7   // other versions keep it elsewhere, or have none
namespace
{
// Private members can be named where a template is instantiated.
juce::Timer& repaintTimerOf (juce::LinuxComponentPeer&);
void followDisplay (juce::LinuxComponentPeer&);

template <auto Timer, auto Follow>
struct Opened
{
    friend juce::Timer& repaintTimerOf (juce::LinuxComponentPeer& p) { return p.*Timer; }
    friend void followDisplay (juce::LinuxComponentPeer& p) { (p.*Follow)(); }
};
template struct Opened<&juce::LinuxComponentPeer::vBlankManager, &juce::LinuxComponentPeer::updateVBlankTimer>;
}   // namespace

void setRepaintRate (juce::ComponentPeer& peer, std::optional<int> per_second)
{
    auto* window = dynamic_cast<juce::LinuxComponentPeer*> (&peer);
    if (window == nullptr || ! repaintTimerOf (*window).isTimerRunning()) return;
    auto& timer = repaintTimerOf (*window);
    if (! per_second) return followDisplay (*window);
    if (timer.getTimerInterval() != 1000 / *per_second) timer.startTimer (1000 / *per_second);
}

namespace
{
juce::X11Symbols::XNextEvent next_event_of_x = nullptr;

int nextEvent (::Display* display, XEvent* event)
{
    const int result = next_event_of_x (display, event);
    if (event->type == juce::KeyPressEventType || event->type == KeyRelease) juce::updateKeyModifiers (static_cast<int> (event->xkey.state));
    return result;
}
}   // namespace

void takeHeldKeysFromEvents()
{
    juce::XWindowSystem::getInstance();   // loads the functions of X11
    auto& next = juce::X11Symbols::getInstance()->xNextEvent;
    if (next != &nextEvent) next_event_of_x = std::exchange (next, &nextEvent);
}
#else
void setRepaintRate (juce::ComponentPeer&, std::optional<int>)
{
}

void takeHeldKeysFromEvents() {}
#endif

void paintWithoutDisplay()
{
#if JUCE_WINDOWS
    auto& desktop = juce::Desktop::getInstance();
    for (int i = desktop.getNumComponents(); --i >= 0;)
        if (auto* window = desktop.getComponent (i); window != nullptr && window->getPeer() != nullptr) window->getPeer()->performAnyPendingRepaintsNow();
#endif
}

}   // namespace tactus::host
