// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// The field of a dialog for files in which the name is typed.
inline juce::TextEditor* nameField (juce::Component& in)
{
    for (auto* child : in.getChildren())
    {
        if (auto* field = dynamic_cast<juce::TextEditor*> (child)) return field;
        if (dynamic_cast<juce::ComboBox*> (child) != nullptr) continue;   // the folder
        // NOLINTNEXTLINE(clang-analyzer-core.NonNullParamChecker): no child is null, though the casts before it would also take null
        if (auto* found = nameField (*child)) return found;
    }
    return nullptr;
}

/// The list of a dialog for files.
inline juce::FileBrowserComponent* browserIn (juce::Component& in)
{
    for (auto* child : in.getChildren())
    {
        if (auto* browser = dynamic_cast<juce::FileBrowserComponent*> (child)) return browser;
        if (auto* found = browserIn (*child)) return found;
    }
    return nullptr;
}

}   // namespace tactus::host
