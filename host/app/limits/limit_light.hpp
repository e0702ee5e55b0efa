// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "limit_list.hpp"

#include <host/app/look/button.hpp>
#include <host/app/look/look.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

/// A light with the number of limits that the graph breaks (red) or nearly breaks (amber). Without those, it is grey if some limits are
/// unknown, else green. It is a button: the tooltip says which limits these are. Invisible until the graph has been checked.
class LimitLight final : public Button
{
public:
    static constexpr int width = 136;

    LimitLight() : Button (TRANS ("limits"))
    {
        setVisible (false);
        setWantsKeyboardFocus (false);   // the keys stay with the canvas
        setMouseClickGrabsKeyboardFocus (false);
    }

    /// The list of an earlier state is not shown as a verdict: until the new one is there, the light says that it is being checked.
    void show (const LimitList&, bool is_up_to_date = true);

    void paintButton (juce::Graphics&, bool over, bool down) override;

private:
    LimitList shown;
    bool is_of_now = true;
};

/// Draws a light for a limit: a red disc if it is broken, an amber ring if it is near.
void drawLimitLight (juce::Graphics&, juce::Rectangle<float>, bool is_broken, const Theme&);

}   // namespace tactus::host
