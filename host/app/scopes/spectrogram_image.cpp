// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectrogram_image.hpp"

#include <host/tools/figures/colours.hpp>
#include <host/tools/figures/spectrogram.hpp>

#include <bit>
#include <cmath>

namespace tactus::host
{

namespace
{
constexpr float empty_value = -1000.0f;
constexpr double scale_step_db = 10.0, quietest_top_db = -100.0;
}   // namespace

void SpectrogramImage::begin (const TraceList& traces, const View& v)
{
    clear();
    view = v;
    port = traces.front()->name();
    rate_hz = traces.front()->rate();
    ticks_each = std::max<std::uint64_t> (1, static_cast<std::uint64_t> (std::llround (view.seconds * rate_hz / view.columns)));
    values.assign (static_cast<std::size_t> (view.columns) * static_cast<std::size_t> (view.rows), empty_value);
    image = juce::Image (juce::Image::ARGB, view.columns, view.rows, true, juce::SoftwareImageType());
    const auto shown = ticks_each * static_cast<std::uint64_t> (view.columns), end = endOf (traces);
    next = (end > shown ? end - shown : 0) / ticks_each;
}

void SpectrogramImage::update (const TraceList& traces, const View& v)
{
    is_behind = false;
    if (traces.empty() || v.columns < 1 || v.rows < 1 || ! (v.hz.size() > 0.0)) return clear();
    const auto& first = *traces.front();
    const auto all = static_cast<std::uint64_t> (v.columns);
    const bool is_new_run = first.end()<next * ticks_each, is_too_late = endOf (traces) / ticks_each> next + all;
    if (! (view == v) || port != first.name() || rate_hz != first.rate() || is_new_run || is_too_late) begin (traces, v);
    const auto end = endOf (traces) / ticks_each;   // columns that are complete
    for (int i = 0; i < most_columns_at_once && next < end; ++i)
        addColumn (traces, (next + 1) * ticks_each);
    is_behind = next < end;
    findScale();
}

void SpectrogramImage::addColumn (const TraceList& traces, std::uint64_t end)
{
    const auto samples = static_cast<std::uint64_t> (std::max (16.0, std::round (window_s * rate_hz)));
    Components parts;
    for (const auto& t : traces)
    {
        if (t->end() < end || end < samples || t->begin() + samples > end) continue;
        auto& part = parts.emplace_back();
        t->each (end - samples, end, [&] (std::uint64_t, double v) {
            const double before = part.empty() ? 0.0 : part.back();
            part.push_back (isPlottable (v) ? v : before);
        });
    }
    const int x = static_cast<int> (next++ % static_cast<std::uint64_t> (view.columns));
    ++computed;
    auto* column = &values[static_cast<std::size_t> (x) * static_cast<std::size_t> (view.rows)];
    std::fill_n (column, view.rows, empty_value);
    loudest_hz = 0.0;
    if (! parts.empty())
    {
        const std::vector<std::span<const double>> spans (parts.begin(), parts.end());
        const auto length = 2 * std::bit_ceil (static_cast<std::size_t> (samples));
        const auto lines = amplitudesOf (spans, rate_hz, length, view.hz.high);
        const double step = rate_hz / static_cast<double> (length);
        float loudest = empty_value;
        for (int row = 0; row < view.rows; ++row)
        {
            const auto lineAt = [&] (int r) { return (view.hz.low + view.hz.size() * r / view.rows) / step; };
            const auto from = static_cast<std::size_t> (std::max (0.0, lineAt (row))), to = static_cast<std::size_t> (std::max (0.0, lineAt (row + 1)));
            double highest = 0.0;
            for (auto line = from; line < std::max (from + 1, to) && line < lines.size(); ++line)
                highest = std::max (highest, lines[line]);
            column[row] = static_cast<float> (20.0 * std::log10 (std::max (highest, 1e-12)));
            if (column[row] <= loudest || highest <= 1e-12) continue;
            loudest = column[row];
            loudest_hz = view.hz.low + view.hz.size() * (row + 0.5) / view.rows;
            loudest_db = double { loudest };
        }
    }
    if (! scale.isEmpty()) colourColumn (x);
}

void SpectrogramImage::colourColumn (int x)
{
    const auto* column = &values[static_cast<std::size_t> (x) * static_cast<std::size_t> (view.rows)];
    const juce::Image::BitmapData pixels (image, x, 0, 1, view.rows, juce::Image::BitmapData::writeOnly);
    for (int row = 0; row < view.rows; ++row)
    {
        const auto c = colourOfLevel ((double { column[row] } - scale.low) / scale.size());
        const bool is_empty = column[row] <= empty_value;
        pixels.setPixelColour (0, view.rows - 1 - row, is_empty ? juce::Colours::transparentBlack : juce::Colour (c.red, c.green, c.blue));
    }
}

/// The colours reach up to the loudest value in the picture, in steps, so that the whole picture is rarely coloured again.
void SpectrogramImage::findScale()
{
    if (values.empty()) return;
    const auto loudest = double { *std::ranges::max_element (values) };
    if (loudest <= double { empty_value }) return;
    const double top = std::max (quietest_top_db, scale_step_db * std::ceil (loudest / scale_step_db));
    if (! scale.isEmpty() && scale.high == top) return;
    scale = { top - range_db, top };
    for (int x = 0; x < view.columns; ++x)
        colourColumn (x);
}

void SpectrogramImage::draw (juce::Graphics& g, juce::Rectangle<float> area) const
{
    if (! image.isValid() || scale.isEmpty()) return;
    const juce::Graphics::ScopedSaveState restore (g);
    g.setOpacity (1.0f);
    g.setImageResamplingQuality (juce::Graphics::lowResamplingQuality);
    const int oldest = static_cast<int> (next % static_cast<std::uint64_t> (view.columns)), newer = view.columns - oldest;
    const auto draw_part = [&] (int from, int count, int at) {
        if (count <= 0) return;
        const float pixel = area.getWidth() / static_cast<float> (view.columns);
        const auto where = area.withX (area.getX() + pixel * static_cast<float> (at)).withWidth (pixel * static_cast<float> (count));
        g.drawImage (image.getClippedImage ({ from, 0, count, view.rows }), where, juce::RectanglePlacement::stretchToFit);
    };
    draw_part (oldest, newer, 0);
    draw_part (0, oldest, newer);
}

}   // namespace tactus::host
