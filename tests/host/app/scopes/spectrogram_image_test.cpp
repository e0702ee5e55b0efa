// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/scopes/spectrogram_image.hpp>

#include "made_trace.hpp"

#include <host/tools/figures/colours.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

using namespace tactus::host;

namespace
{
constexpr double trace_rate = 4000.0;
constexpr int wide = 200, high = 100;

std::shared_ptr<Trace> toneTrace() { return emptyTrace ("a.force", trace_rate); }

/// Adds a tone to the end of a trace.
void extend (Trace& trace, double hz, double seconds, double amplitude = 1.0)
{
    const auto first = trace.end(), count = static_cast<std::uint64_t> (seconds * trace_rate);
    for (auto tick = first; tick < first + count; ++tick)
        trace.add (tick, amplitude * std::sin (2.0 * std::numbers::pi * hz * static_cast<double> (tick) / trace_rate));
}

SpectrogramImage::View viewOf (double seconds = 2.0, double up_to_hz = 1000.0) { return { wide, high, seconds, { 0.0, up_to_hz } }; }

void catchUp (SpectrogramImage& picture, const TraceList& traces, const SpectrogramImage::View& view)
{
    do
        picture.update (traces, view);
    while (picture.isBehind());
}

juce::Image drawn (const SpectrogramImage& picture)
{
    juce::Image image (juce::Image::ARGB, wide, high, true);
    juce::Graphics g (image);
    picture.draw (g, image.getBounds().toFloat());
    return image;
}

/// The brightest row of a column, counted from the lowest.
int brightestRow (const juce::Image& image, int x)
{
    const auto brightness = [&] (int row) { return image.getPixelAt (x, high - 1 - row).getPerceivedBrightness(); };
    int brightest = 0;
    for (int row = 0; row < high; ++row)
        if (brightness (row) > brightness (brightest)) brightest = row;
    return brightest;
}
}   // namespace

TEST_CASE ("scopes: a spectrogram shows a tone in the row of its frequency, the latest at the right", "[app][scopes][spectrogram]")
{
    const juce::ScopedJuceInitialiser_GUI juce;
    rc::check ("two tones, one after the other", [] {
        const double first = *rc::gen::inRange (50, 950), second = *rc::gen::inRange (50, 950);
        const auto trace = toneTrace();
        extend (*trace, first, 1.0);
        extend (*trace, second, 1.0);
        SpectrogramImage picture;
        catchUp (picture, { trace }, viewOf());
        const auto image = drawn (picture);
        const auto rowOf = [] (double hz) { return hz / 1000.0 * high; };
        RC_ASSERT (std::abs (brightestRow (image, wide / 4) + 0.5 - rowOf (first)) <= 1.5);
        RC_ASSERT (std::abs (brightestRow (image, wide - 2) + 0.5 - rowOf (second)) <= 1.5);
        RC_ASSERT (std::abs (picture.loudestHz() - second) <= 15.0);
        RC_ASSERT (std::abs (picture.loudestDb()) < 0.6);
    });
}

TEST_CASE ("scopes: a spectrogram computes each column once, and a few at a time", "[app][scopes][spectrogram]")
{
    const juce::ScopedJuceInitialiser_GUI juce;
    const auto trace = toneTrace();
    extend (*trace, 200.0, 2.0);
    SpectrogramImage picture;
    picture.update ({ trace }, viewOf());
    CHECK (picture.columns() == SpectrogramImage::most_columns_at_once);
    CHECK (picture.isBehind());
    catchUp (picture, { trace }, viewOf());
    CHECK (picture.columns() == wide);
    picture.update ({ trace }, viewOf());
    CHECK (picture.columns() == wide);   // nothing new
    extend (*trace, 200.0, 0.1);         // ten columns of 10 ms
    picture.update ({ trace }, viewOf());
    CHECK (picture.columns() == wide + 10);
    CHECK_FALSE (picture.isBehind());
}

TEST_CASE ("scopes: a spectrogram that was built while scrolling equals one that is built in one step", "[app][scopes][spectrogram]")
{
    const juce::ScopedJuceInitialiser_GUI juce;
    const auto trace = toneTrace();
    SpectrogramImage scrolled;
    for (int i = 0; i < 40; ++i)
    {
        extend (*trace, 100.0 + 20.0 * i, 0.11);
        catchUp (scrolled, { trace }, viewOf());
    }
    SpectrogramImage whole;
    catchUp (whole, { trace }, viewOf());
    const auto a = drawn (scrolled), b = drawn (whole);
    int different = 0;
    for (int y = 0; y < high; ++y)
        for (int x = 0; x < wide; ++x)
            different += a.getPixelAt (x, y) != b.getPixelAt (x, y);
    CHECK (different == 0);
}

TEST_CASE ("scopes: the scale of a spectrogram follows the loudest value in the picture in steps of 10 dB", "[app][scopes][spectrogram]")
{
    const juce::ScopedJuceInitialiser_GUI juce;
    const auto trace = toneTrace();
    SpectrogramImage picture;
    CHECK (picture.decibels().isEmpty());
    extend (*trace, 200.0, 1.0, 0.02);   // -34 dB
    catchUp (picture, { trace }, viewOf());
    CHECK (picture.decibels().high == -30.0);
    CHECK (picture.decibels().size() == SpectrogramImage::range_db);
    extend (*trace, 200.0, 0.5, 2.0);   // 6 dB
    catchUp (picture, { trace }, viewOf());
    CHECK (picture.decibels().high == 10.0);
    extend (*trace, 200.0, 3.0, 0.02);   // the loud part has left the picture
    catchUp (picture, { trace }, viewOf());
    CHECK (picture.decibels().high == -30.0);
}

TEST_CASE ("scopes: gaps, an empty trace and a new run do not upset a spectrogram", "[app][scopes][spectrogram]")
{
    const juce::ScopedJuceInitialiser_GUI juce;
    SpectrogramImage picture;
    picture.update ({}, viewOf());
    picture.update ({ toneTrace() }, viewOf());
    CHECK (picture.decibels().isEmpty());
    auto trace = toneTrace();
    extend (*trace, 300.0, 1.0);
    trace->add (trace->end() + 400, 0.0);   // a gap of 0.1 s
    extend (*trace, 300.0, 0.5);
    catchUp (picture, { trace }, viewOf());
    CHECK (picture.loudestHz() == Approx (300.0).margin (15.0));
    const auto before = picture.columns();
    trace = toneTrace();   // starts at tick 0 again
    extend (*trace, 700.0, 0.5);
    catchUp (picture, { trace }, viewOf());
    CHECK (picture.columns() < before);
    CHECK (picture.loudestHz() == Approx (700.0).margin (15.0));
    picture.update ({ trace }, { 0, 0, 1.0, { 0.0, 100.0 } });
    CHECK (picture.columns() == 0);
}
