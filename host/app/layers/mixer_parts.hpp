// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The functions that the edits of mixers share.

#include "mixer.hpp"

#include <host/app/model/obvious_wires.hpp>

namespace tactus::host::mixing
{

inline constexpr std::string_view number_mixer = "layer.mix", vector_mixer = "layer.mix_vectors";

inline bool isMixer (std::string_view type) noexcept { return type == number_mixer || type == vector_mixer; }

/// Names in the form in which the setting `names` stores them.
std::string joined (std::vector<std::string> names);

/// The names of the layers with one more at the end. The position of a name is the number of commas before it, so no name is empty.
std::string namesWith (const graph::Node& mixer, int layers, const std::string& last);

Message mixerIsGone();
Message mixerIsFull();

}   // namespace tactus::host::mixing
