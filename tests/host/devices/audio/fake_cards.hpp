// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/audio/card.hpp>

#include <chrono>
#include <cstdint>
#include <vector>

namespace tactus::test
{

/// A virtual sound card: the test triggers its blocks.
class FakeCards final : public host::audio::CardSystem
{
public:
    bool there = true;
    int outputs = 4, inputs = 2, block = 64;
    double rate_hz = 48'000.0;
    double speed = 1.0;   ///< how much faster than it says the card plays
    int opened = 0;
    std::vector<std::vector<float>> played { 4 }, spoken { 2 };   ///< samples by channel; the input, `spoken`, is repeated

    std::vector<std::string> types() override { return { "JACK", "ALSA" }; }
    std::vector<host::audio::ListedCard> list() override { return {}; }

    Result<std::unique_ptr<host::audio::OpenCard>> open (const host::audio::CardRequest& w, int outs, int ins, host::audio::CardUser& u) override
    {
        const auto refused = [] (const char* id) {
            Message m;
            m.id = id;
            m.text = "the fake card does not open";
            return m;
        };
        wanted = w;
        if (! there) return refused ("audio/no_card");
        if (outs > outputs || ins > inputs) return refused ("audio/channel");
        ++opened;
        has_out = outs;
        has_in = ins;
        u.begin ({ .type = "JACK", .name = "fake", .rate_hz = rate_hz, .block = block, .outputs = outs, .inputs = ins });
        user = &u;
        return std::make_unique<Card> (*this);
    }

    /// Plays one block, if the card is there and open.
    void play()
    {
        if (user == nullptr || ! there) return;
        std::vector<std::vector<float>> out (static_cast<std::size_t> (has_out), std::vector<float> (static_cast<std::size_t> (block))),
            in (static_cast<std::size_t> (has_in), std::vector<float> (static_cast<std::size_t> (block)));
        std::vector<float*> outs;
        std::vector<const float*> ins;
        for (auto& channel : out)
            outs.push_back (channel.data());
        for (std::size_t c = 0; c < in.size(); ++c)
        {
            for (std::size_t i = 0; i < in[c].size() && ! spoken[c].empty(); ++i)
                in[c][i] = spoken[c][(heard + i) % spoken[c].size()];
            ins.push_back (in[c].data());
        }
        user->block (ins.data(), has_in, outs.data(), has_out, block);
        heard += static_cast<std::size_t> (block);
        for (std::size_t c = 0; c < out.size(); ++c)
            played[c].insert (played[c].end(), out[c].begin(), out[c].end());
    }

    std::chrono::steady_clock::time_point now() const noexcept override
    {
        const double s = static_cast<double> (heard) / (rate_hz * speed);
        return std::chrono::steady_clock::time_point (std::chrono::nanoseconds (static_cast<std::int64_t> (1e9 * s)));
    }

    host::audio::CardRequest wanted;

private:
    struct Card final : host::audio::OpenCard
    {
        explicit Card (FakeCards& c) : cards (c) {}
        ~Card() override { cards.user = nullptr; }
        std::uint64_t xruns() const noexcept override { return 3; }
        FakeCards& cards;
    };

    host::audio::CardUser* user = nullptr;
    int has_out = 0, has_in = 0;
    std::size_t heard = 0;
};

}   // namespace tactus::test
