// SPDX-License-Identifier: MIT
#pragma once

/// The datasheet of a node type as structs of the C interface.

#include "setting_values.hpp"

#include <tactus/node/catalogue.hpp>

#include <deque>
#include <string>
#include <vector>

namespace tactus::plugin
{

/// A tactus_plugin_node, and everything that it points to. Its address must not change.
class Described
{
public:
    explicit Described (const NodeType&);
    ~Described();
    Described (const Described&) = delete;
    Described& operator= (const Described&) = delete;

    tactus_plugin_node node {};

private:
    const char* text (std::string_view);
    const tactus_plugin_unit* unit (const UnitRule&);
    const tactus_plugin_limits* limit (const Limits&);
    const tactus_plugin_port* port (const PortSheet&);
    const tactus_plugin_setting* setting (const SettingSheet&);
    const tactus_plugin_appearance* look (const Appearance&);

    std::deque<std::string> texts;
    std::deque<tactus_plugin_unit> units;
    std::deque<tactus_plugin_limits> limits;
    std::deque<std::vector<const char*>> choices;
    std::deque<tactus_plugin_port> ports;
    std::deque<std::vector<const tactus_plugin_setting*>> fields;
    std::deque<tactus_plugin_setting> settings;
    std::deque<SettingValue> initials;   // the values that `initial` writes point into these
    ValueWriter initial;
    std::vector<const tactus_plugin_port*> port_list;
    std::vector<const tactus_plugin_setting*> setting_list;
    tactus_plugin_appearance appearance {};
    std::vector<const char*> part_names, part_rows;   // of the appearance
};

}   // namespace tactus::plugin
