// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trace_window.hpp"

#include <juce_graphics/juce_graphics.h>

#include <cstdint>
#include <vector>

namespace tactus::host
{

/// The picture of a spectrogram that scrolls: a column of pixels for each step in time. Only new columns are computed and drawn, and only
/// a few at a time, so that neither the length of the picture nor a change of its size makes the window wait. [main thread]
class SpectrogramImage
{
public:
    static constexpr int most_columns_at_once = 24;
    static constexpr double window_s = 0.1, range_db = 60.0;

    struct View
    {
        int columns = 0, rows = 0;   ///< pixels
        double seconds = 5.0;
        Extent hz {};   ///< of the rows

        bool operator== (const View& o) const noexcept
        {
            return columns == o.columns && rows == o.rows && seconds == o.seconds && hz.low == o.hz.low && hz.high == o.hz.high;
        }
    };

    /// Adds the columns that are not yet in the picture. The traces are the components of one port. A change of the view or of the run
    /// starts a new picture.
    void update (const TraceList&, const View&);
    void clear() { *this = {}; }

    /// Draws the picture, the latest column at the right.
    void draw (juce::Graphics&, juce::Rectangle<float>) const;

    const Extent& decibels() const noexcept { return scale; }     ///< of the darkest and the brightest colour; empty: no columns yet
    std::uint64_t columns() const noexcept { return computed; }   ///< number of columns computed since the picture began
    bool isBehind() const noexcept { return is_behind; }          ///< there are more columns to compute
    double loudestHz() const noexcept { return loudest_hz; }      ///< in the latest column; 0: silent
    double loudestDb() const noexcept { return loudest_db; }

private:
    void begin (const TraceList&, const View&);
    void addColumn (const TraceList&, std::uint64_t end);
    void colourColumn (int x);
    void findScale();

    View view;
    std::string port;
    double rate_hz = 0.0;
    std::uint64_t ticks_each = 1, next = 0;   // ticks per column; the column that is computed next, counted from tick 0
    std::uint64_t computed = 0;
    bool is_behind = false;
    std::vector<float> values;   // dB, column by column, from the lowest row; a ring like the image
    juce::Image image;           // a ring: column n is at x = n % columns
    Extent scale;
    double loudest_hz = 0.0, loudest_db = 0.0;
};

}   // namespace tactus::host
