// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "block.hpp"

#include <host/app/limits/limit_list.hpp>

#include <functional>
#include <vector>

namespace tactus::host
{

/// How steep a contact may become: a bar over its stiffness with the parts where it is passive, stable and unstable, and a mark where it is now.
/// Takes no room while nothing is known.
class LimitBlock final : public Block
{
public:
    explicit LimitBlock (std::function<std::vector<ContactLimit>()>);

    int heightFor (int width) override;
    void refresh (const graph::Node*) override;
    void paint (juce::Graphics&) override;

    /// The sentence below a bar.
    static juce::String textOf (const ContactLimit&);

private:
    std::function<std::vector<ContactLimit>()> get;
    std::vector<ContactLimit> shown;
};

}   // namespace tactus::host
