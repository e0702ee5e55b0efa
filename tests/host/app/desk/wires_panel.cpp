// SPDX-License-Identifier: GPL-3.0-or-later
// The number of nodes and wires, in the window.
#include <host/app/desk/panel.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

namespace
{
class Wires final : public juce::Component
{
public:
    Wires() { setTitle (TRANS ("Wires")); }   // for screen readers

    void show (const graph::Patch& p)
    {
        const auto now = filled (TRANS ("%1 nodes, %2 wires"), p.nodes.size(), p.wires.size());
        if (now == text) return;
        text = now;
        repaint();
    }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        g.fillAll (look.theme().panel);
        g.setColour (look.theme().text);
        g.setFont (look.font (13.0f));
        g.drawText (text, getLocalBounds().reduced (16), juce::Justification::topLeft, true);
    }

private:
    juce::String text;
};
}   // namespace

Panel wiresPanel (Desk& desk)
{
    auto made = std::make_unique<Wires>();
    auto* wires = made.get();
    return { .name = TRANS ("Wires"),
             .component = std::move (made),
             .keys = { { "ctrl + t", NEEDS_TRANS ("Ctrl+T"), NEEDS_TRANS ("counts the nodes and wires"), [&desk, wires] { desk.reveal (*wires); } } },
             .refresh = [&desk, wires] { wires->show (desk.document.graph().root); } };
}

}   // namespace tactus::host
