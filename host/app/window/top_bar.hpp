// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

#include <functional>
#include <vector>

namespace tactus::host
{

/// Where one is: the name of the graph, and the subgraphs that were entered, each a button that leads back out.
class TopBar final : public juce::Component
{
public:
    static constexpr int height = 40;

    void show (std::vector<juce::String> way, bool changed);

    std::function<void (std::size_t depth)> onLeave;

    void paint (juce::Graphics&) override;
    void mouseUp (const juce::MouseEvent&) override;
    void mouseMove (const juce::MouseEvent&) override;

private:
    std::vector<juce::Rectangle<float>> places() const;

    std::vector<juce::String> way;
    bool changed = false;
};

}   // namespace tactus::host
