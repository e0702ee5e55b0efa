// SPDX-License-Identifier: MIT
#include <host/app/run/sound.hpp>

#include <catch2/catch.hpp>

#include <juce_events/juce_events.h>

using namespace tactus::host;

namespace
{
/// Ticks and blocks of samples as two clocks bring them, one of them faster than it says.
std::vector<float> play (Sound& sound, double tick_rate, double fast, double seconds, const std::function<double (double)>& newton)
{
    constexpr double rate = 48000.0;
    constexpr int block = 128;
    sound.setTickRate (tick_rate);
    std::vector<float> heard;
    std::vector<float> samples (block);
    double ticks = 0.0;
    for (double t = 0.0; t < seconds; t += block / rate)
    {
        for (; ticks < t * tick_rate * fast; ticks += 1.0)
            sound.push (newton (ticks / tick_rate));
        sound.render (samples.data(), block, rate);
        heard.insert (heard.end(), samples.begin(), samples.end());
    }
    return heard;
}
}   // namespace

TEST_CASE ("a vibration is heard at its pitch and without a click", "[app][sound]")
{
    juce::ScopedJuceInitialiser_GUI juce_runs;
    Sound sound;
    sound.setVolume (1.0f);
    sound.listenWithoutCard();
    const auto heard = play (sound, 4000.0, 1.0, 2.0, [] (double t)
                             { return std::sin (2.0 * M_PI * 250.0 * t); });
    int rises = 0;
    float loudest = 0.0f, steepest = 0.0f;
    for (std::size_t i = 48000; i < heard.size(); ++i)
    {
        rises += heard[i - 1] < 0.0f && heard[i] >= 0.0f ? 1 : 0;
        loudest = std::max (loudest, std::abs (heard[i]));
        steepest = std::max (steepest, std::abs (heard[i] - heard[i - 1]));
    }
    CHECK (rises == Approx (250).margin (3));   // within what the clocks may be pulled by
    CHECK (loudest == Approx (1.0 / Sound::newton_at_full_scale).epsilon (0.1));
    CHECK (steepest < loudest * 2.0f * 3.1416f * 250.0f / 48000.0f * 1.3f);
}

TEST_CASE ("clocks that differ by 200 ppm do not run into each other", "[app][sound]")
{
    juce::ScopedJuceInitialiser_GUI juce_runs;
    const double fast = GENERATE (1.0 - 200e-6, 1.0 + 200e-6);
    Sound sound;
    sound.listenWithoutCard();
    play (sound, 4000.0, fast, 1.0, [] (double)
          { return 0.5; });
    const auto before = sound.underruns();
    play (sound, 4000.0, fast, 600.0, [] (double)
          { return 0.5; });
    CHECK (sound.underruns() == before);
}

TEST_CASE ("what stands still is silent, and what is not a number too", "[app][sound]")
{
    juce::ScopedJuceInitialiser_GUI juce_runs;
    Sound sound;
    sound.listenWithoutCard();
    const auto constant = play (sound, 1000.0, 1.0, 2.0, [] (double)
                                { return 3.0; });
    CHECK (std::abs (constant.back()) < 1e-3f);
    const auto broken = play (sound, 1000.0, 1.0, 1.0, [] (double)
                              { return std::nan (""); });
    CHECK (std::ranges::all_of (broken, [] (float x)
                                { return std::isfinite (x); }));
}
