// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/run/sound.hpp>

#include "host/devices/audio/fake_cards.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace tactus::host;
using tactus::test::FakeCards;

namespace
{
/// Runs ticks and audio blocks. Returns what the card played.
std::vector<float> play (Sound& sound, FakeCards& card, double tick_rate, double seconds, const std::function<double (double)>& newton)
{
    sound.setTickRate (tick_rate);
    REQUIRE (sound.start());
    double ticks = 0.0;
    for (double t = 0.0; t < seconds; t += card.block / card.rate_hz)
    {
        for (; ticks < t * tick_rate; ticks += 1.0)
            sound.push (newton (ticks / tick_rate));
        card.play();
    }
    CHECK (card.played[0] == card.played[1]);
    return card.played[0];
}
}   // namespace

TEST_CASE ("a vibration is played at its pitch, without clicks", "[app][sound]")
{
    FakeCards card;
    Sound sound { card };
    const auto heard = play (sound, card, 4000.0, 2.0, [] (double t) { return std::sin (2.0 * M_PI * 250.0 * t); });
    int rises = 0;
    float loudest = 0.0f, steepest = 0.0f;
    for (std::size_t i = 48000; i < heard.size(); ++i)
    {
        rises += heard[i - 1] < 0.0f && heard[i] >= 0.0f ? 1 : 0;
        loudest = std::max (loudest, std::abs (heard[i]));
        steepest = std::max (steepest, std::abs (heard[i] - heard[i - 1]));
    }
    CHECK (rises == Approx (250).margin (1));
    CHECK (loudest == Approx (std::tanh (1.0 / Sound::newton_at_full_scale)).epsilon (0.01));
    CHECK (steepest < loudest * 2.0f * 3.1416f * 250.0f / 48000.0f * 1.05f);
    CHECK (sound.report().underruns == 0);
}

TEST_CASE ("a constant force is silent, and so are values that are not numbers", "[app][sound]")
{
    FakeCards card;
    Sound sound { card };
    const auto constant = play (sound, card, 1000.0, 2.0, [] (double) { return 3.0; });
    CHECK (std::abs (constant.back()) < 1e-3f);
    const auto broken = play (sound, card, 1000.0, 1.0, [] (double) { return std::nan (""); });
    CHECK (std::ranges::all_of (broken, [] (float x) { return std::isfinite (x); }));
}

TEST_CASE ("without a sound card there is an error, and a run at a different rate can be heard too", "[app][sound]")
{
    FakeCards card;
    card.there = false;
    Sound sound { card };
    const auto started = sound.start();
    REQUIRE_FALSE (started);
    CHECK (started.error().id == "audio/no_card");
    CHECK_FALSE (sound.isOn());

    card.there = true;
    card.outputs = 1;
    CHECK (sound.start());
    CHECK (sound.isOn());
    sound.setTickRate (1000.0);
    CHECK (sound.isOn());
    CHECK (card.opened == 2);
    sound.stop();
    CHECK_FALSE (sound.isOn());
}
