// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "on_stage.hpp"

#include <host/app/run/live_run.hpp>

namespace tactus::host::test
{

/// Presses on the surface at both of its sides. True if the tool goes there.
inline bool followsMouse (OnStage& w, LiveRun& run)
{
    auto* surface = w.titled ("Surface");
    REQUIRE (surface != nullptr);
    const auto at = [&] (float part) {
        const auto area = surface->getLocalBounds().toFloat();
        return w.stage->getLocalPoint (surface, juce::Point<float> (part * (area.getWidth() - 64.0f), area.getCentreY()));
    };
    const auto isAt = [&] (double sign) {
        const auto tool = run.tool();
        return tool && sign * tool->position.x() > 0.02 && tool->position.z() < 0.0;
    };
    w.stage->move (at (0.2f));
    w.stage->press();
    const bool left = waitFor ([&] { return isAt (-1.0); });
    w.stage->move (at (0.8f));
    const bool right = waitFor ([&] { return isAt (1.0); });
    w.stage->release();
    return left && right;
}

}   // namespace tactus::host::test
