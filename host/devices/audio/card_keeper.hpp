// SPDX-License-Identifier: MIT
#pragma once

#include "card.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>

namespace tactus::host::audio
{

/// Keeps a card open: notices when it goes away, and reopens it when it is back.
class CardKeeper final : private CardUser
{
public:
    using Clock = std::chrono::steady_clock;

    /// After this time without a block, or if blocks are long, after this many block lengths, the readings of a card are not valid.
    static constexpr double silence_s = 0.1;
    static constexpr double silence_blocks = 4.0;
    static constexpr std::chrono::milliseconds gone_after { 500 };    // the card is closed after this time without a block
    static constexpr std::chrono::milliseconds retry_after { 500 };   // pause between attempts; longer if they are slow: they take at most 1/rarity of the time
    static constexpr int rarity = 20;

    /// The system and the user must outlive the keeper. [main thread]
    CardKeeper (CardSystem& s, CardUser& u) : system (s), user (u) {}
    ~CardKeeper() override { close(); }

    /// Opens a card. If it fails, poll() retries until close(). [main thread]
    Result<> open (const CardRequest&, int outputs, int inputs);
    void close();

    /// Must be called many times a second. [main thread]
    void poll (Clock::time_point now = Clock::now());

    bool isOpen() const noexcept { return card != nullptr; }                                   ///< [main thread]
    const OpenedFormat& format() const noexcept { return opened; }                             ///< the latest format [main thread]
    const Result<>& lastAttempt() const noexcept { return last_attempt; }                      ///< result of the latest attempt to open the card [main thread]
    std::uint64_t blocks() const noexcept { return count.load (std::memory_order_acquire); }   ///< [any thread]
    std::uint64_t xruns() const noexcept { return before + (card ? card->xruns() : 0); }       ///< [main thread]
    std::uint64_t departures() const noexcept { return gone; }                                 ///< [main thread]

private:
    void begin (const OpenedFormat&) override;
    void block (const float* const*, int, float* const*, int, int) noexcept override;
    Result<> tryAgain (Clock::time_point);

    CardSystem& system;
    CardUser& user;
    CardRequest wanted;
    int outputs = 0, inputs = 0;
    bool is_wanted = false;
    OpenedFormat opened;
    Result<> last_attempt;
    std::uint64_t before = 0, gone = 0, seen = 0;
    Clock::time_point last {}, tried {};
    Clock::duration pause = retry_after;
    std::atomic<std::uint64_t> count = 0;
    std::unique_ptr<OpenCard> card;   // declared last: it calls the functions of this object
};

}   // namespace tactus::host::audio
