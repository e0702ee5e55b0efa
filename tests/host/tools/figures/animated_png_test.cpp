// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/tools/figures/animated_png.hpp>

#include "host/tools/figures/played_png.hpp"

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <juce_events/juce_events.h>

using namespace tactus::host;
using tactus::test::isSame;
using tactus::test::PlayedPng;

TEST_CASE ("an animated PNG plays the frames that were added, each for its time", "[host][io][film]")
{
    rc::check ("frames that differ in random rectangles", [] {
        const int width = *rc::gen::inRange (1, 60), height = *rc::gen::inRange (1, 40), count = *rc::gen::inRange (1, 6);
        juce::Image frame (juce::Image::RGB, width, height, true, juce::SoftwareImageType());
        const int tolerance = *rc::gen::element (0, 3, 40);
        AnimatedPng made { tolerance };
        std::vector<juce::Image> frames;
        std::vector<double> seconds;
        for (int i = 0; i < count; ++i)
        {
            for (int n = *rc::gen::inRange (0, 3); n > 0; --n)
            {
                const int x = *rc::gen::inRange (0, width), y = *rc::gen::inRange (0, height);
                const int wide = *rc::gen::inRange (1, width + 1), high = *rc::gen::inRange (1, height + 1);
                const auto colour = *rc::gen::arbitrary<std::uint32_t>();
                juce::Graphics g (frame);
                g.setColour (juce::Colour (colour | 0xff000000u));
                g.fillRect (x, y, wide, high);
            }
            const auto ms = static_cast<std::uint16_t> (*rc::gen::inRange (10, 2000));
            frames.push_back (frame.createCopy());
            seconds.push_back (ms / 1000.0);
            RC_ASSERT (made.add (frame.createCopy(), ms));
        }
        const PlayedPng played { made.file() };
        RC_ASSERT (played.seconds == seconds);
        RC_ASSERT (played.plays == 0u);
        RC_ASSERT (played.frames.size() == frames.size());
        for (std::size_t i = 0; i < frames.size(); ++i)
            RC_ASSERT (isSame (played.frames[i], frames[i], tolerance));
    });
}

TEST_CASE ("an animated PNG keeps only what changes, and refuses a frame of another size", "[host][io][film]")
{
    juce::Image noise (juce::Image::RGB, 200, 200, true, juce::SoftwareImageType());
    juce::Random random (1);
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x)
            noise.setPixelAt (x, y, juce::Colour (static_cast<juce::uint32> (random.nextInt()) | 0xff000000u));
    AnimatedPng made;
    REQUIRE (made.add (noise, 40));
    const auto one = made.file().size();
    for (int i = 0; i < 10; ++i)
        REQUIRE (made.add (noise, 40));
    CHECK (made.file().size() < one + 10 * 150);
    CHECK (made.frames() == 11);

    // A moving line in noise costs its own pixels, not the whole rectangle around its old and new places.
    AnimatedPng moves;
    std::size_t still = 0;
    for (int i = 0; i < 10; ++i)
    {
        auto frame = noise.createCopy();
        for (int k = 0; k < 200; ++k)
            frame.setPixelAt (k, (k + 20 * i) % 200, juce::Colours::white);
        REQUIRE (moves.add (frame, 40));
        if (i == 0) still = moves.file().size();
    }
    CHECK (moves.file().size() < still + 9 * 5000);

    // Small changes do not add up unseen.
    AnimatedPng slow { 3 };
    juce::Image grey (juce::Image::RGB, 8, 8, true, juce::SoftwareImageType());
    for (int i = 0; i < 20; ++i)
    {
        juce::Graphics (grey).fillAll (juce::Colour::greyLevel (0.5f + static_cast<float> (i) / 255.0f));
        REQUIRE (slow.add (grey.createCopy(), 40));
        CHECK (isSame (PlayedPng { slow.file() }.frames.back(), grey, 3));
    }
    CHECK_FALSE (made.add (juce::Image (juce::Image::RGB, 100, 200, true, juce::SoftwareImageType()), 40));
    CHECK (PlayedPng { made.file (false) }.plays == 1);
}
