// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/fitted_text.hpp>

#include <tactus/node/catalogue.hpp>

#include <functional>
#include <string>

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// A menu of the usual modulators. `add` receives the type of the node that the user chooses.
inline juce::PopupMenu modulatorMenu (const Catalogue& catalogue, const std::function<void (const std::string& type)>& add)
{
    juce::PopupMenu menu;
    for (const std::string type : { "signal.lfo", "signal.envelope", "signal.noise" })
        if (const auto* known = catalogue.find (type)) menu.addItem (fromUtf8 (known->info.name), [add, type] { add (type); });
    menu.addItem (TRANS ("Speed of the hand"), [add] { add ("motion.velocity"); });
    return menu;
}

}   // namespace tactus::host
