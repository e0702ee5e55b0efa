// SPDX-License-Identifier: GPL-3.0-or-later
#include "direct_stop.hpp"

#include <array>

namespace tactus::host
{

std::optional<Message> DirectStop::follow (juce::Component& component, juce::Rectangle<int> part)
{
    auto* peer = component.getPeer();
    const auto window = peer != nullptr ? reinterpret_cast<std::uintptr_t> (peer->getNativeHandle()) : 0;
    std::optional<Message> why;
    if (window != watched)
    {
        watched = window;
        watch.reset();
        if (window != 0)
        {
            auto opened = WindowStop::open (window, { [&s = pressed] { s.stop (By::person); },
                                                      [this] { if (esc_stops) pressed.stop (By::person); },
                                                      [&s = pressed] { s.emergencyStop (By::person); } });
            if (opened)
                watch = std::move (*opened);
            else
                why = std::move (opened).error();
        }
    }
    if (! watch) return why;
    watchOthers();
    auto& top = peer->getComponent();
    const double scale = top.getDesktopScaleFactor() * peer->getPlatformScaleFactor();
    const auto pixels = (top.getLocalArea (&component, part).toDouble() * scale).toNearestInt();
    watch->setArea ({ static_cast<std::int16_t> (pixels.getX()), static_cast<std::int16_t> (pixels.getY()),
                      static_cast<std::uint16_t> (pixels.getWidth()), static_cast<std::uint16_t> (pixels.getHeight()) });
    return why;
}

/// Watches the other windows of the program, such as a file dialog, or the question whether to replace a file.
void DirectStop::watchOthers()
{
    std::array<std::uintptr_t, WindowStop::most_others> windows {};
    std::size_t count = 0;
    for (int i = 0; i < juce::ComponentPeer::getNumPeers() && count < windows.size(); ++i)
        if (const auto window = reinterpret_cast<std::uintptr_t> (juce::ComponentPeer::getPeer (i)->getNativeHandle()); window != watched)
            windows[count++] = window;
    watch->setOthers (windows);
}

}   // namespace tactus::host
