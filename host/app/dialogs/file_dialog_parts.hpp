// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// The first component of a type inside another. Leaves out combo boxes, which have fields of their own.
template <typename Wanted>
Wanted* firstInside (juce::Component& in)
{
    for (auto* child : in.getChildren())
    {
        if (child == nullptr || dynamic_cast<juce::ComboBox*> (child) != nullptr) continue;
        if (auto* wanted = dynamic_cast<Wanted*> (child)) return wanted;
        if (auto* wanted = firstInside<Wanted> (*child)) return wanted;
    }
    return nullptr;
}

/// The field of a dialog for files in which the name is typed.
inline juce::TextEditor* nameField (juce::Component& in)
{
    return firstInside<juce::TextEditor> (in);
}

/// The list of a dialog for files.
inline juce::FileBrowserComponent* browserIn (juce::Component& in)
{
    return firstInside<juce::FileBrowserComponent> (in);
}

}   // namespace tactus::host
