// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "audio_settings.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace tactus::host::audio
{

/// A sound card that there is.
struct ListedCard
{
    std::string type, name;
    std::vector<std::string> outputs {}, inputs {};   ///< names of the channels
    std::vector<double> rates {};                     ///< Hz
    std::vector<int> blocks {};                       ///< frames
    std::string trouble {};                           ///< why no more is known of it
};

/// A card as it was opened.
struct OpenedFormat
{
    std::string type, name;
    double rate_hz = 0.0;
    int block = 0;   ///< frames
    int outputs = 0, inputs = 0;
    double latency_s = 0.0;   ///< of the card itself, on the way out
};

/// What a card plays and hears.
class CardUser
{
public:
    virtual ~CardUser() = default;

    /// Before the first block. [main thread]
    virtual void begin (const OpenedFormat&) = 0;

    /// So many frames, channel by channel; fewer channels than were asked for where a system has taken some away. [audio thread]
    virtual void block (const float* const* in, int ins, float* const* out, int outs, int frames) noexcept = 0;
};

/// An open card: it calls its user until it is destroyed, or goes away. That it has is only seen by no more blocks: what
/// systems say of it comes in the middle of their own clearing up, at times from threads that still use the card.
class OpenCard
{
public:
    virtual ~OpenCard() = default;
    virtual std::uint64_t xruns() const noexcept = 0;   ///< blocks that came too late, as far as the system counts them [main thread]
};

/// Where cards come from.
class CardSystem
{
public:
    virtual ~CardSystem() = default;
    virtual std::vector<std::string> types() = 0;   // [main thread]
    virtual std::vector<ListedCard> list() = 0;     // [main thread]

    /// With at least so many channels. `begin` of the user is called before. Ids: audio/no_card, audio/rate, audio/block,
    /// audio/channel, audio/cannot_open. [main thread]
    virtual std::variant<std::unique_ptr<OpenCard>, Message> open (const CardWanted&, int outputs, int inputs, CardUser&) = 0;
};

/// The cards of this computer, by JUCE.
CardSystem& soundCards();

}   // namespace tactus::host::audio
