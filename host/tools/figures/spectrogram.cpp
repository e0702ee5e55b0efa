// SPDX-License-Identifier: MIT
#include "spectrogram.hpp"
#include "plot.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tactus::host
{

namespace
{
constexpr std::size_t line_padding = 2;   // a line is then at most 0.4 dB below the amplitude of a sine
constexpr double quietest = 1e-12;
}   // namespace

std::vector<double> amplitudesOf (std::span<const std::span<const double>> components, double rate_hz, std::size_t length, double up_to_hz)
{
    std::vector<double> all;
    for (const auto& samples : components)
    {
        const auto spectrum = spectrumOf (samples, rate_hz, length);
        const auto wanted = static_cast<std::size_t> (std::max (0.0, std::floor (up_to_hz / spectrum.step_hz))) + 1;
        all.resize (std::min (wanted, spectrum.amplitude.size()));
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = std::hypot (all[i], spectrum.amplitude[i]);
    }
    return all;
}

Spectrogram spectrogramOf (const Components& signal, double rate_hz, double window_s, double up_to_hz, std::size_t most_columns)
{
    Spectrogram all;
    const auto window = static_cast<std::size_t> (std::max (8.0, std::round (window_s * rate_hz)));
    const auto samples = signal.empty() ? 0 : signal.front().size();
    if (samples < window || most_columns == 0) return all;
    const auto length = line_padding * std::bit_ceil (window), room = samples - window;
    const auto hop = std::max<std::size_t> ({ 1, window / 8, (room + most_columns - 1) / most_columns });
    all.step_hz = rate_hz / static_cast<double> (length);
    for (std::size_t from = 0; from <= room; from += hop)
    {
        std::vector<std::span<const double>> parts;
        for (const auto& component : signal)
            parts.push_back (std::span (component).subspan (from, window));
        all.at.push_back ((static_cast<double> (from) + 0.5 * static_cast<double> (window)) / rate_hz);
        all.columns.push_back (amplitudesOf (parts, rate_hz, length, up_to_hz));
    }
    return all;
}

double ridgeOf (const Spectrogram& s, std::size_t column, double from_hz)
{
    const auto& lines = s.columns[column];
    const auto first = std::min (lines.size(), static_cast<std::size_t> (std::max (1.0, std::ceil (from_hz / s.step_hz))));
    const auto highest = std::max_element (lines.begin() + static_cast<std::ptrdiff_t> (first), lines.end());
    return highest == lines.end() || *highest <= quietest ? 0.0 : static_cast<double> (highest - lines.begin()) * s.step_hz;
}

HeatMap heatMapOf (const Spectrogram& s, const std::string& unit, double decibels)
{
    HeatMap map { .colour = { "amplitude", unit.empty() || unit == "1" ? "dB" : "dB re 1 " + unit } };
    if (s.columns.empty()) return map;
    map.columns = s.columns.size();
    const auto lines = s.columns.front().size();
    map.rows = std::max<std::size_t> (1, 2 * (lines - 1));   // each line takes half a row below its frequency and half a row above it
    const double half = s.at.size() < 2 ? 0.5 * std::max (1e-9, std::abs (s.at[0])) : 0.5 * (s.at[1] - s.at[0]);
    map.x = { s.at.front() - half, s.at.back() + half };
    map.y = { 0.0, std::max (1.0, static_cast<double> (lines - 1)) * s.step_hz };
    double loudest = quietest;
    for (const auto& column : s.columns)
        for (std::size_t row = 0; row < map.rows; ++row)
        {
            const double a = column[(row + 1) / 2];
            loudest = std::max (loudest, a);
            map.values.push_back (20.0 * std::log10 (std::max (a, quietest)));
        }
    const double top = 20.0 * std::log10 (loudest);
    map.range = { top - decibels, top };
    return map;
}

}   // namespace tactus::host
