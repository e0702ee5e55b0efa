// SPDX-License-Identifier: MIT
#include "setting_values.hpp"

#include <stdexcept>
#include <variant>

namespace tactus::plugin
{

ValueWriter::~ValueWriter()
{
    for (const auto* asset : assets)
        asset->release (asset);
}

const tactus_plugin_value* ValueWriter::operator() (const SettingValue& value)
{
    auto& made = all.emplace_back (std::visit ([this] (const auto& v) { return this->shown (v); }, static_cast<const SettingValue::variant&> (value)));
    return &made;
}

namespace
{
Values readRecord (const tactus_plugin_value& v, Keep keep)
{
    Values fields;
    for (std::size_t i = 0; i < v.count; ++i)
        fields.push_back (readValue (*v.values[i], keep));
    return fields;
}
}   // namespace

SettingValue readValue (const tactus_plugin_value& v, Keep keep)
{
    switch (v.kind)
    {
    case TACTUS_PLUGIN_NUMBER:
    case TACTUS_PLUGIN_INTEGER:
        return v.a;
    case TACTUS_PLUGIN_TEXT:
        return std::string (v.text, v.count);
    case TACTUS_PLUGIN_VECTOR:
        return Vec3 (v.x[0], v.x[1], v.x[2]);
    case TACTUS_PLUGIN_NUMBERS:
        return std::vector<double> (v.x, v.x + v.count);
    case TACTUS_PLUGIN_CURVE:
        return readCurve (v);
    case TACTUS_PLUGIN_LAW:
        return readLaw (v);
    case TACTUS_PLUGIN_RECORD:
        return readRecord (v, keep);
    case TACTUS_PLUGIN_RECORDS:
    {
        Records all;
        for (std::size_t i = 0; i < v.count; ++i)
            all.push_back (readRecord (*v.values[i], keep));
        return all;
    }
    case TACTUS_PLUGIN_SIGNAL:
        return imported<Signal, tactus_plugin_signal> (v.asset, keep);
    case TACTUS_PLUGIN_IMAGE:
        return Image { imported<Grid, tactus_plugin_grid> (v.asset, keep) };
    case TACTUS_PLUGIN_TABLE:
        return Sheet { imported<Grid, tactus_plugin_grid> (v.asset, keep) };
    case TACTUS_PLUGIN_SURFACE:
        return imported<Surface, tactus_plugin_surface> (v.asset, keep);
    default:
        throw std::invalid_argument ("a value has the unknown kind " + std::to_string (v.kind));
    }
}

}   // namespace tactus::plugin
