// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cards.hpp"

namespace tactus::host
{

/// The devices for the roles of the graph. For each role: what it needs, what it is bound to and whether that fits, its status, its
/// workspace, and the limits of its guard. Also the clock of the run, and what the sound card plays.
class DevicesPanel final : public juce::Component
{
public:
    DevicesPanel (Document&, LiveRun&, DeviceSetup&);
    ~DevicesPanel() override;

    void refresh();   ///< call many times a second; does nothing while hidden

    DeviceBindings& bindings() noexcept { return edited; }
    std::function<Result<> (const std::string& role)> onTry;   ///< plays a gentle pulse on the device of a role
    void tryDevice (const std::string& role);

    std::size_t cards() const noexcept { return columns.size(); }   ///< one for the clock, one for each role, and one for the sound card
    Column& card (std::size_t i) { return *columns[i]; }

    void paint (juce::Graphics&) override;
    void resized() override;
    void visibilityChanged() override;

private:
    void show();
    void rebuild();

    DeviceSetup& setup;
    DeviceBindings edited;
    DeviceCards made;
    DeviceBindings::Shape shown;
    std::vector<std::unique_ptr<Column>> columns;
    juce::Viewport scroll;
    juce::Component sheet;
    int refreshes = 0;
};

}   // namespace tactus::host
