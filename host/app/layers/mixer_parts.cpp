// SPDX-License-Identifier: GPL-3.0-or-later
#include "mixer_parts.hpp"

#include <host/app/text/filled.hpp>
#include <tactus/kit/list.hpp>
#include <tactus/text/list_text.hpp>

namespace tactus::host::mixing
{

std::string joined (std::vector<std::string> names)
{
    while (! names.empty() && names.back().empty())
        names.pop_back();
    return listText (names);
}

std::string namesWith (const graph::Node& mixer, int layers, const std::string& last)
{
    auto names = layerNames (mixer, layers);
    names.back() = last;
    for (std::size_t i = 0; i + 1 < names.size(); ++i)
        if (names[i].empty()) names[i] = "layer " + std::to_string (i + 1);
    return joined (std::move (names));
}

Message mixerIsGone() { return Message::error ("mixer/gone", {}, TRANS ("the mixer no longer exists").toStdString()); }

Message mixerIsFull()
{
    return Message::error ("mixer/full", {}, filled (TRANS ("a mixer has at most %1 layers"), list_capacity).toStdString(),
                           TRANS ("add a second mixer").toStdString());
}

}   // namespace tactus::host::mixing
