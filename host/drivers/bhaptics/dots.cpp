// SPDX-License-Identifier: MIT
#include "dots.hpp"

#include <host/drivers/websocket/member.hpp>
#include <tactus/node/device.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tactus::host
{
namespace
{
constexpr std::size_t most_dots = 256;

std::optional<Vec3> vectorOf (const Json* json)
{
    if (json == nullptr || ! json->is_array() || json->size() != 3) return std::nullopt;
    Vec3 v;
    for (std::size_t i = 0; i < 3; ++i)
    {
        if (! (*json)[i].is_number() || ! isFinite ((*json)[i].get<double>())) return std::nullopt;
        v[static_cast<int> (i)] = (*json)[i].get<double>();
    }
    return v;
}

/// A number above 0.
std::optional<double> amountOf (const Json* json)
{
    if (json == nullptr || ! json->is_number()) return std::nullopt;
    const double number = json->get<double>();
    return isFinite (number) && number > 0.0 ? std::optional (number) : std::nullopt;
}

int intensityOf (double amount) noexcept { return static_cast<int> (std::floor (100.0 * std::clamp (amount, 0.0, 1.0) + 0.5)); }
}   // namespace

Result<Dots> Dots::read (const Json& map, const Json& description)
{
    const auto wrong = [] (std::string why) { return Message::error ("dots/wrong", "", std::move (why)); };
    Dots all;
    if (auto why = all.readPlaces (map); ! why.empty()) return wrong (std::move (why));
    const auto* own = member (description, "channels");
    const auto* channels = own != nullptr ? own : member (map, "channels");
    if (channels == nullptr || ! channels->is_array() || channels->size() == 0 || channels->size() > static_cast<std::size_t> (Channels::most))
        return wrong ("\"channels\" is a list of 1 to " + std::to_string (Channels::most) + R"( channels, such as [{"dots": {"VestFront": [0, 1]}}])");
    for (const auto& channel : *channels)
        if (auto why = all.readChannel (channel); ! why.empty()) return wrong ("channel " + std::to_string (all.weights.size() + 1) + " " + why);
    if (const auto* full = member (description, "full_force"))
    {
        const auto force = amountOf (full);
        if (! force) return wrong ("\"full_force\" is the force in N that drives a motor with its full intensity, above 0");
        all.full_force = *force;
    }
    all.peaks.assign (all.weights.size(), 0.0);
    all.pushed.assign (all.dots.size(), 0.0);
    return all;
}

std::string Dots::readPlaces (const Json& map)
{
    const auto* given = member (map, "places");
    if (given == nullptr || ! given->is_object()) return "the map has no places";
    for (const auto& [name, place] : given->items())
    {
        const auto out = vectorOf (member (place, "out"));
        const auto* at = member (place, "at");
        if (! out || at == nullptr || ! at->is_array()) return "the place " + std::string (name) + " has no \"out\" or no \"at\"";
        for (const auto& motor : *at)
        {
            const auto where = vectorOf (&motor);
            if (! where || dots.size() == most_dots) return "the place " + std::string (name) + " has a motor without a position, or too many";
            const auto first = std::ranges::find (dots, places.size(), &Dot::place);
            dots.push_back ({ places.size(), static_cast<int> (dots.end() - first), *where, *out });
        }
        places.push_back ({ .name = std::string (name) });
    }
    return {};
}

std::string Dots::readChannel (const Json& channel)
{
    std::vector<double> of (dots.size(), 0.0);
    if (const auto* at = member (channel, "at"))
    {
        const auto where = vectorOf (at);
        const auto radius = amountOf (member (channel, "radius"));
        if (! where || ! radius) return R"(has a place that cannot be: write {"at": [0, 0.1, 0.1], "radius": 0.1}, in m)";
        for (std::size_t i = 0; i < dots.size(); ++i)
            of[i] = std::max (0.0, 1.0 - (dots[i].at - *where).norm() / *radius);
        if (std::ranges::all_of (of, [] (double w) { return w == 0.0; })) return "has no motor within its radius";
        weights.push_back (std::move (of));
        return {};
    }
    const auto* groups = member (channel, "dots");
    if (groups == nullptr || ! groups->is_object()) return R"(has neither "dots" nor "at")";
    for (const auto& [name, indices] : groups->items())
    {
        const auto place = std::ranges::find (places, std::string (name), &Place::name) - places.begin();
        if (place == static_cast<std::ptrdiff_t> (places.size()) || ! indices.is_array())
            return "names a place that the vest does not have: " + std::string (name);
        for (const auto& index : indices)
        {
            const auto dot = std::ranges::find_if (dots, [&] (const Dot& d) {
                return d.place == static_cast<std::size_t> (place) && index.is_number() && static_cast<double> (d.index) == index.get<double>();
            });
            if (dot == dots.end()) return "names a motor of " + std::string (name) + " that the vest does not have";
            of[static_cast<std::size_t> (dot - dots.begin())] = 1.0;
        }
    }
    weights.push_back (std::move (of));
    return {};
}

void Dots::take (std::span<const double> signals, const Vec3& force) noexcept
{
    for (std::size_t c = 0; c < std::min (signals.size(), peaks.size()); ++c)
        if (isFinite (signals[c])) peaks[c] = std::max (peaks[c], std::abs (signals[c]));
    if (! isFinite (force.sum())) return;
    for (std::size_t i = 0; i < dots.size(); ++i)
        pushed[i] = std::max (pushed[i], -force.dot (dots[i].out) / full_force);
}

void Dots::forget() noexcept
{
    std::ranges::fill (peaks, 0.0);
    std::ranges::fill (pushed, 0.0);
}

void Dots::limit (double part) noexcept
{
    constexpr double rounding = 1e-9;   // 0.29 is 29
    most = isFinite (part) ? static_cast<int> (std::floor (100.0 * std::clamp (part, 0.0, 1.0) + rounding)) : 100;
}

std::string Dots::message()
{
    std::vector<int> intensities (dots.size());
    for (std::size_t i = 0; i < dots.size(); ++i)
    {
        double sum = pushed[i];
        for (std::size_t c = 0; c < weights.size(); ++c)
            sum += weights[c][i] * peaks[c];
        intensities[i] = std::min (intensityOf (sum), most);
    }
    forget();

    std::string entries;
    for (std::size_t p = 0; p < places.size(); ++p)
    {
        std::string points;
        for (std::size_t i = 0; i < dots.size(); ++i)
            if (dots[i].place == p && intensities[i] > 0)
                points += std::string (points.empty() ? "" : ",") + "{\"index\":" + std::to_string (dots[i].index)
                          + ",\"intensity\":" + std::to_string (intensities[i]) + "}";
        auto& place = places[p];
        const bool did_show = place.shows;
        place.shows = ! points.empty();
        if (! place.shows && ! did_show) continue;
        const auto key = "\"Key\":\"tactus_" + place.name + "\"";
        entries += entries.empty() ? "" : ",";
        if (place.shows)
            entries += "{\"Type\":\"frame\"," + key + ",\"Frame\":{\"position\":\"" + place.name + "\",\"dotPoints\":[" + points
                       + "],\"pathPoints\":[],\"durationMillis\":" + std::to_string (duration_ms) + "}}";
        else
            entries += "{\"Type\":\"turnOff\"," + key + "}";
    }
    return entries.empty() ? std::string() : "{\"Submit\":[" + entries + "]}";
}

std::string Dots::silence()
{
    forget();
    std::string entries;
    for (auto& place : places)
    {
        place.shows = false;
        entries += (entries.empty() ? "" : ",") + ("{\"Type\":\"turnOff\",\"Key\":\"tactus_" + place.name) + "\"}";
    }
    return "{\"Submit\":[" + entries + "]}";
}

bool Dots::isShowing() const noexcept { return std::ranges::any_of (places, &Place::shows); }

}   // namespace tactus::host
