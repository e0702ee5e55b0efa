// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>
#include <host/app/model/document.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

/// The controls of the graph as knobs, which stay in reach whatever is selected. Drag a knob, turn the wheel over it, or use the arrow
/// keys; a double click on the dial types a value, and one on the name renames it. A right click opens a menu. A knob is dimmed and does not turn if wires
/// set all its targets.
/// A ring around a knob shows how far modulators move its targets; drag the ring to change that of the first one, for all targets.
class KnobStrip final : public juce::Component
{
public:
    KnobStrip (Document&, const Catalogue&);
    ~KnobStrip() override;

    void refresh();   ///< after each change of the document
    bool isEmpty() const noexcept { return knobs.empty(); }
    int heightFor (int width) const;
    std::size_t size() const noexcept { return knobs.size(); }
    juce::Slider& knob (std::size_t i);
    void rename (const std::string& control);   ///< opens the field for the name of a control

    std::function<void (const juce::String&)> onHint;                                       ///< receives the reason why a knob has no effect
    std::function<void (const std::string& control, const std::string& type)> onModulate;   ///< adds a node of this type that moves what a control sets
    void fillMenu (juce::PopupMenu&, std::size_t knob);                                     ///< the menu of a right click on a knob

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    class Knob;
    int columnsFor (int width) const;

    Document& document;
    const Catalogue& catalogue;
    std::vector<std::unique_ptr<Knob>> knobs;
};

}   // namespace tactus::host
