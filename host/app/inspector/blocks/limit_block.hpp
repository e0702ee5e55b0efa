// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "block.hpp"

#include <host/app/limits/limit_list.hpp>

#include <functional>
#include <limits>
#include <vector>

namespace tactus::host
{

/// A display of how steep a contact may become. It is a bar over the stiffness with the parts where the contact is passive, stable and unstable, and
/// a mark where it is now. It takes no room while nothing is known.
class LimitBlock final : public Block
{
public:
    explicit LimitBlock (std::function<std::vector<ContactLimit>()>);

    int heightFor (int width) override;
    void refresh (const graph::Node*) override;
    void paint (juce::Graphics&) override;

    /// The sentence below a bar.
    static juce::String textOf (const ContactLimit&);

    /// The ends of the parts of a bar, as multiples of the stiffness now. The sentence has each of them, or it is the mark at 1, where trials were made.
    /// The part between `stable` and `swings` is not judged.
    struct Parts
    {
        double passive = 0.0, stable = 0.0, swings = std::numeric_limits<double>::infinity(), end = 1.0;
    };
    static Parts partsOf (const ContactLimit&);

private:
    std::function<std::vector<ContactLimit>()> get;
    std::vector<ContactLimit> shown;
};

}   // namespace tactus::host
