// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "highlights.hpp"

#include <host/app/canvas/navigation/view.hpp>
#include <host/app/look/look.hpp>

namespace tactus::host
{

void paintGrid (juce::Graphics&, const View&, juce::Rectangle<int> area, const Theme&);

/// Paints the notes, wires and nodes of a scene, in the graphics context of the component.
void paintScene (juce::Graphics&, const Scene&, const View&, const Look&, const Highlights&);

/// The two parts of paintScene(): the notes and the wires that are painted together, and above them everything else. `paintsNodes` does so in place of
/// paintNodes(), in the context of the component.
void paintBelow (juce::Graphics&, const Scene&, const View&, const Look&, const Highlights&);
void paintAbove (juce::Graphics&, const Scene&, const View&, const Look&, const Highlights&, const std::function<void()>& paintsNodes = {});

}   // namespace tactus::host
