// SPDX-License-Identifier: GPL-3.0-or-later
#include "box.hpp"

#include <host/app/model/param_value.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/readable.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace tactus::host
{

namespace
{
constexpr float glyph_width = 22.0f, gap = 20.0f;

float toGrid (float x) { return std::ceil (x / Box::grid) * Box::grid; }

/// A quantity whose number has at most six digits: a node has no room for all of 569.343065693 mN, which its field shows.
std::string briefly (const std::string& text)
{
    constexpr std::size_t usual_length = 8;
    const auto end = std::min (text.find (' '), text.size());
    const auto number = end > usual_length ? wholeNumber (text.substr (0, end)) : std::nullopt;
    return number ? roundedText (*number) + text.substr (end) : text;
}

/// A text about as long as that of a value while a graph runs.
std::string longestLive (const FacePort& port)
{
    const bool has_unit = port.unit.kind == UnitRule::Kind::fixed && port.unit.unit.symbol != "1";
    const auto unit = has_unit ? " m" + unitShown (std::string (port.unit.unit.symbol)) : std::string();
    return port.width == 3 ? "(-0.00, -0.00, -0.00)" : "-0.0000" + unit;
}
}   // namespace

std::string valueText (const Json& value, const FacePort& port)
{
    if (value.is_string())
    {
        const auto text = value.get<std::string>();
        const auto space = text.rfind (' ');
        return briefly (space == text.npos ? text : text.substr (0, space + 1) + unitShown (text.substr (space + 1)));
    }
    if (value.is_number())
        return briefly (shownQuantity (value.get<double>(), port.unit.kind == UnitRule::Kind::fixed ? port.unit.unit.symbol : std::string_view {}));
    if (! value.is_array()) return {};
    const auto partText = [] (const Json& part) {
        if (part.is_number()) return briefly (numberText (part.get<double>()));
        return part.is_string() ? briefly (part.get<std::string>()) : "?";
    };
    std::string text;
    for (const auto& part : value)
        addToList (text, partText (part));
    return '(' + text + ')';
}

const Socket* Box::find (Role role, std::string_view id) const noexcept
{
    const auto socket = std::ranges::find_if (sockets, [&] (const Socket& s) { return s.port->role == role && s.port->id == id; });
    return socket == sockets.end() ? nullptr : &*socket;
}

namespace
{
/// In the order of the datasheet, so that no row moves as the user sets or wires one. A wire adds its row, if it is not shown, and takes none away.
std::vector<const FacePort*> shownParams (const graph::Node& node, const Face& face, const std::function<bool (const FacePort&)>& wired)
{
    std::set<const FacePort*> chosen;
    for (const bool set : { true, false })
        for (const auto& p : face.params)
            if (chosen.size() < Box::most_params && node.params.contains (baseOf (p.id)) == set) chosen.insert (&p);
    std::vector<const FacePort*> params;
    for (const auto& p : face.params)
        if (chosen.contains (&p) || wired (p)) params.push_back (&p);
    return params;
}
}   // namespace

Box boxOf (const graph::Node& node, const Face& face, const std::function<bool (const FacePort&)>& wired,
           const std::function<Json (const FacePort&)>& valueNow, const std::function<std::string (const FacePort&)>& driver,
           const std::function<std::string (const FacePort&)>& depth, bool has_plot, const TextWidth& widthOf)
{
    const auto params = shownParams (node, face, wired);
    Box box;
    const auto textWidth = [&] (const std::string& text) { return widthOf (text, Box::label_size, false); };
    const auto rows = std::max (face.inputs.size(), face.outputs.size());
    box.width = glyph_width + std::min (Box::widest_title, widthOf (node.name, Box::title_size, true)) + 2 * Box::padding;
    for (std::size_t i = 0; i < rows; ++i)
    {
        const float left = i < face.inputs.size() ? textWidth (readableName (face.inputs[i])) : 0.0f;
        const float right = i < face.outputs.size() ? textWidth (readableName (face.outputs[i])) : 0.0f;
        box.width = std::max (box.width, left + right + (left > 0.0f && right > 0.0f ? gap : 0.0f) + 2 * Box::padding);
    }
    std::vector<std::string> values, drivers, depths;
    for (const auto* p : params)
    {
        drivers.push_back (driver (*p));
        depths.push_back (depth (*p));
        values.push_back (drivers.back().empty() ? valueText (valueNow (*p), *p) : std::string());
        float shown = drivers.back().empty() ? textWidth (values.back()) : std::max (textWidth (drivers.back()), textWidth (longestLive (*p)));
        if (! depths.back().empty()) shown += Box::before_depth + textWidth (depths.back());
        box.width = std::max (box.width, textWidth (readableName (*p)) + shown + gap + 2 * Box::padding);
    }
    box.width = toGrid (box.width);

    float y = Box::header_height;
    for (std::size_t i = 0; i < rows; ++i, y += Box::row_height)
    {
        const juce::Rectangle<float> row { 0.0f, y, box.width, Box::row_height };
        const float y_middle = row.getCentreY(), half = box.width / 2;
        if (i < face.inputs.size())
            box.sockets.push_back ({ &face.inputs[i], { 0.0f, y_middle }, row.withWidth (half), {}, readableName (face.inputs[i]) });
        if (i < face.outputs.size())
            box.sockets.push_back ({ &face.outputs[i], { box.width, y_middle }, row.withTrimmedLeft (half), {}, readableName (face.outputs[i]) });
    }
    for (std::size_t i = 0; i < params.size(); ++i, y += Box::row_height)
    {
        const juce::Rectangle<float> row { 0.0f, y, box.width, Box::row_height };
        box.sockets.push_back ({ params[i], { 0.0f, row.getCentreY() }, row, values[i], readableName (*params[i]), drivers[i], depths[i] });
    }
    if (has_plot)
    {
        box.plot = { Box::padding, y + 4.0f, box.width - 2 * Box::padding, Box::plot_height };
        y = box.plot.getBottom();
    }
    box.height = toGrid (y + 4.0f);
    return box;
}

}   // namespace tactus::host
