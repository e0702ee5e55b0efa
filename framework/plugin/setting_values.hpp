// SPDX-License-Identifier: MIT
#pragma once

/// Translates values of settings to and from the C interface, for hosts and plugins. setting_values.cpp is compiled once, not with
/// each plugin: that halves the time until an edited node runs.

#include "exported_asset.hpp"
#include "imported_asset.hpp"

#include <tactus/node/setting.hpp>

#include <deque>

namespace tactus::plugin
{

static_assert (static_cast<int> (SettingSheet::Kind::surface) == TACTUS_PLUGIN_SURFACE, "the C interface numbers the kinds as SettingSheet does");

/// Shows values of settings to the other side. What it returns is valid as long as this object and the value exist.
class ValueWriter
{
public:
    ValueWriter() = default;
    ValueWriter (const ValueWriter&) = delete;
    ValueWriter& operator= (const ValueWriter&) = delete;
    ~ValueWriter();

    const tactus_plugin_value* operator() (const SettingValue&);

private:
    static tactus_plugin_value shown (double number) { return numberValue (number); }
    static tactus_plugin_value shown (const Law& law) { return lawValue (law); }

    static tactus_plugin_value shown (const std::string& text)
    {
        auto v = valueOfKind (TACTUS_PLUGIN_TEXT);
        v.text = text.c_str();
        v.count = text.size();
        return v;
    }

    static tactus_plugin_value shown (const Vec3& p) { return numbers (TACTUS_PLUGIN_VECTOR, p.data(), 3); }
    static tactus_plugin_value shown (const std::vector<double>& n) { return numbers (TACTUS_PLUGIN_NUMBERS, n.data(), n.size()); }

    static tactus_plugin_value shown (const Curve& curve) { return curveValue (curve); }

    tactus_plugin_value shown (const Values& record) { return list (TACTUS_PLUGIN_RECORD, record); }
    tactus_plugin_value shown (const Records& records) { return list (TACTUS_PLUGIN_RECORDS, records); }

    tactus_plugin_value shown (const std::shared_ptr<const Signal>& s) { return asset (s, TACTUS_PLUGIN_SIGNAL); }
    tactus_plugin_value shown (const std::shared_ptr<const Surface>& s) { return asset (s, TACTUS_PLUGIN_SURFACE); }
    tactus_plugin_value shown (const Image& i) { return asset (i.grid, TACTUS_PLUGIN_IMAGE); }
    tactus_plugin_value shown (const Sheet& s) { return asset (s.grid, TACTUS_PLUGIN_TABLE); }

    static tactus_plugin_value numbers (int kind, const double* first, std::size_t count)
    {
        auto v = valueOfKind (kind);
        v.x = first;
        v.count = count;
        return v;
    }

    template <typename List>
    tactus_plugin_value list (int kind, const List& parts)
    {
        std::vector<const tactus_plugin_value*> shown_parts;
        for (const auto& part : parts)
            if constexpr (std::is_same_v<List, Records>)
                shown_parts.push_back (&all.emplace_back (shown (part)));
            else
                shown_parts.push_back ((*this) (part));
        auto& kept = lists.emplace_back (std::move (shown_parts));
        auto v = valueOfKind (kind);
        v.values = kept.data();
        v.count = kept.size();
        return v;
    }

    template <typename T>
    tactus_plugin_value asset (const std::shared_ptr<const T>& content, int kind)
    {
        auto v = valueOfKind (kind);
        v.asset = ExportedAsset::of (content, kind);
        if (v.asset != nullptr) assets.push_back (v.asset);
        return v;
    }

    std::deque<tactus_plugin_value> all;
    std::deque<std::vector<const tactus_plugin_value*>> lists;
    std::vector<const tactus_plugin_asset*> assets;
};

/// Throws std::invalid_argument if the kind is unknown.
SettingValue readValue (const tactus_plugin_value&, Keep);

}   // namespace tactus::plugin
