// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

namespace tactus::host
{

/// Dims the window while a dialog for files, or a question of such a dialog, is in front of it. [main thread]
class Shade final : public juce::Component
{
public:
    Shade() { setInterceptsMouseClicks (false, false); }

    void follow()   ///< call many times a second
    {
        const bool is_needed = isAnyDialogOpen();
        if (is_needed == isVisible()) return;
        setVisible (is_needed);
        toFront (false);
        if (auto* dialog = getCurrentlyModalComponent(); is_needed && dialog->getParentComponent() == getParentComponent()) toBehind (dialog);
    }

    void paint (juce::Graphics& g) override { dimWindow (g, themeOf (*this)); }

private:
    static bool isAnyDialogOpen()
    {
        for (int i = 0; i < getNumCurrentlyModalComponents(); ++i)
        {
            auto* open = getCurrentlyModalComponent (i);
            if (dynamic_cast<juce::FileChooserDialogBox*> (open) != nullptr || dynamic_cast<juce::AlertWindow*> (open) != nullptr) return true;
        }
        return false;
    }
};

}   // namespace tactus::host
