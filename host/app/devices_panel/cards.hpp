// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "remarks.hpp"

#include <host/app/inspector/blocks/block.hpp>

namespace tactus::host
{

/// The cards of the devices panel, one for the clock, one for each role, and one for the sound card. [main thread]
class DeviceCards
{
public:
    DeviceCards (DeviceBindings& b, const LiveRun& run, DeviceSetup& s) : bindings (b), setup (s), remarks (b, run, s) {}

    std::unique_ptr<Column> clock();
    std::unique_ptr<Column> role (std::size_t);   ///< the role with this number in the shape of the bindings
    std::unique_ptr<Column> sound();              ///< which all runs share: the routes from ports to its channels, and its settings

    std::function<void (const std::string& role)> onTry;

private:
    std::unique_ptr<Block> cardRow (const char* pointer, const char* label, const char* about);

    DeviceBindings& bindings;
    DeviceSetup& setup;
    DeviceRemarks remarks;
};

}   // namespace tactus::host
