// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "variant.hpp"

#include <tactus/graph/graph.hpp>

#include <functional>
#include <memory>

namespace tactus::bench
{

// JUCE runs and edits graphs on the message thread only. [message thread]

/// The reference graph in JUCE.
std::unique_ptr<Variant> juceReference();

/// A graph of one-poles (one_poles.hpp) in JUCE.
std::unique_ptr<Variant> juceOnePoles (const graph::Graph&);

/// The same, to be edited: each call makes one edit, after which JUCE rebuilds what it runs.
std::function<void()> juceEdits (const graph::Graph&);

}   // namespace tactus::bench
