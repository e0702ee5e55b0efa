// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/sessions/audio_settings.hpp>

#include <tactus/text/result.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tactus::host::audio
{

/// A sound card found on this computer.
struct ListedCard
{
    std::string type, name;
    std::vector<std::string> outputs {}, inputs {};   ///< names of the channels
    std::vector<double> rates {};                     ///< Hz
    std::vector<int> blocks {};                       ///< frames per block
    std::string trouble {};                           ///< why the details of the card are unknown; empty if they are known
};

/// The format of an open card.
struct OpenedFormat
{
    std::string type, name;
    double rate_hz = 0.0;
    int block = 0;   ///< frames per block
    int outputs = 0, inputs = 0;
    double latency_s = 0.0;   ///< output latency of the card itself
};

/// Provides the output of a card and receives its input.
class CardUser
{
public:
    virtual ~CardUser() = default;

    /// Called before the first block. [main thread]
    virtual void begin (const OpenedFormat&) = 0;

    /// Processes one block, channel by channel. There may be fewer channels than requested if the system took some away. [audio
    /// thread]
    virtual void block (const float* const* in, int ins, float* const* out, int outs, int frames) noexcept = 0;
};

/// An open card. It calls its user until it is destroyed or goes away. The only sign that it went away is that blocks stop
/// arriving. The system's own report is ignored: it comes in the middle of the system's clean-up, sometimes from threads that
/// still use the card.
class OpenCard
{
public:
    virtual ~OpenCard() = default;
    virtual std::uint64_t xruns() const noexcept = 0;   ///< late blocks, as counted by the system [main thread]
};

/// Lists and opens cards.
class CardSystem
{
public:
    virtual ~CardSystem() = default;
    virtual std::vector<std::string> types() = 0;   // [main thread]
    virtual std::vector<ListedCard> list() = 0;     // [main thread]

    /// Opens a card with at least this many channels, after calling the user's `begin`. Ids: audio/no_card, audio/rate,
    /// audio/block, audio/channel, audio/cannot_open. [main thread]
    virtual Result<std::unique_ptr<OpenCard>> open (const CardRequest&, int outputs, int inputs, CardUser&) = 0;

    /// The wall clock, by which what a card plays is limited. Tests have their own. [any thread]
    virtual std::chrono::steady_clock::time_point now() const noexcept { return std::chrono::steady_clock::now(); }
};

/// The cards of this computer, accessed through JUCE.
CardSystem& soundCards();

}   // namespace tactus::host::audio
