// SPDX-License-Identifier: MIT
#include "colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr Colour sky { 0x56, 0xB4, 0xE9 };
constexpr Colour vermilion { 0xD5, 0x5E, 0x00 };
constexpr Colour orange { 0xE6, 0x9F, 0x00 };
constexpr Colour yellow { 0xF0, 0xE4, 0x42 };
constexpr Colour grey { 0x9A, 0xA5, 0xB1 };
constexpr Colour green { 0x00, 0x9E, 0x73 };
constexpr Colour purple { 0xCC, 0x79, 0xA7 };
constexpr Colour blue { 0x00, 0x72, 0xB2 };

constexpr std::array<std::pair<std::string_view, Colour>, 25> quantities { {
    { "position", sky },
    { "length", sky },
    { "depth", sky },
    { "deflection", sky },
    { "displacement", sky },
    { "force", vermilion },
    { "resistance", vermilion },
    { "normal_force", vermilion },
    { "value", orange },
    { "vibration", orange },
    { "hit", yellow },
    { "event", yellow },
    { "gain", grey },
    { "ratio", grey },
    { "energy", green },
    { "stored_energy", green },
    { "dissipated_energy", green },
    { "rotation", purple },
    { "angle", purple },
    { "torque", purple },
    { "frequency", blue },
    { "spatial_frequency", blue },
    { "rate", blue },
    { "speed", blue },
    { "velocity", blue },
} };

/// Dark and light alternate, so that neighbours also differ in greyscale. Yellow is left out: it is for hits.
constexpr std::array cycle { vermilion, blue, orange, green, purple, sky, grey };

std::optional<Colour> ownColour (std::string_view quantity) noexcept
{
    for (const auto& [name, colour] : quantities)
        if (name == quantity)
            return colour;
    return std::nullopt;
}

/// Relative luminance as WCAG 2 defines it, 0 black to 1 white.
double luminance (Colour colour) noexcept
{
    const auto linear = [] (std::uint8_t channel) {
        const double c = channel / 255.0;
        return c <= 0.03928 ? c / 12.92 : std::pow ((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear (colour.red) + 0.7152 * linear (colour.green) + 0.0722 * linear (colour.blue);
}

double contrastOnWhite (Colour colour) noexcept
{
    return 1.05 / (luminance (colour) + 0.05);
}
}   // namespace

Colour colourFor (std::string_view quantity) noexcept
{
    return ownColour (quantity).value_or (grey);
}

Colour colourFor (std::string_view quantity, std::size_t nth) noexcept
{
    const auto own = ownColour (quantity).value_or (blue);
    if (nth == 0)
        return own;

    auto others = cycle;
    const auto end = std::remove (others.begin(), others.end(), own);
    return others[(nth - 1) % static_cast<std::size_t> (end - others.begin())];
}

Colour colourOfLevel (double part) noexcept
{
    constexpr std::array<Colour, 9> points { { { 0x44, 0x01, 0x54 },
                                               { 0x47, 0x2d, 0x7b },
                                               { 0x3b, 0x52, 0x8b },
                                               { 0x2c, 0x72, 0x8e },
                                               { 0x21, 0x91, 0x8c },
                                               { 0x28, 0xae, 0x80 },
                                               { 0x5e, 0xc9, 0x62 },
                                               { 0xad, 0xdc, 0x30 },
                                               { 0xfd, 0xe7, 0x25 } } };
    const double place = std::clamp (std::isnan (part) ? 0.0 : part, 0.0, 1.0) * static_cast<double> (points.size() - 1);
    const auto below = std::min (static_cast<std::size_t> (place), points.size() - 2);
    const double share = place - static_cast<double> (below);
    const auto mix = [share] (std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t> (std::lround (a + share * (b - a))); };
    const auto &a = points[below], &b = points[below + 1];
    return { mix (a.red, b.red), mix (a.green, b.green), mix (a.blue, b.blue) };
}

Colour onPaper (Colour colour) noexcept
{
    constexpr double faint = 2.0;   // contrast on white below which a colour is darkened; the orange has 2.2, the yellow 1.3
    constexpr double legible = 2.6;
    if (contrastOnWhite (colour) >= faint)
        return colour;

    const auto darker = [] (std::uint8_t channel) { return static_cast<std::uint8_t> (channel * 0.95); };
    while (contrastOnWhite (colour) < legible)
        colour = { darker (colour.red), darker (colour.green), darker (colour.blue) };
    return colour;
}

}   // namespace tactus::host
