// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "card.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

namespace tactus::host::audio
{

/// Keeps a card open: notices when it goes away, and takes it again once it is back.
class CardKeeper final : private CardUser
{
public:
    using Clock = std::chrono::steady_clock;

    /// Without a block for so long a card counts as gone, as far as its readings go, and so long at least where blocks are long.
    static constexpr double silence_s = 0.1;
    static constexpr double silence_blocks = 4.0;
    static constexpr std::chrono::milliseconds gone_after { 500 };    // then it is closed
    static constexpr std::chrono::milliseconds retry_after { 500 };   // and so long that looking takes no more than a part of the thread's time
    static constexpr int rarity = 20;

    /// Both outlive this. [main thread]
    CardKeeper (CardSystem& s, CardUser& u) : system (s), user (u) {}
    ~CardKeeper() override { close(); }

    /// Or why not; then attend() tries again, until close(). [main thread]
    std::optional<Message> open (const CardWanted&, int outputs, int inputs);
    void close();

    /// To be called many times a second. [main thread]
    void attend (Clock::time_point now = Clock::now());

    bool isOpen() const noexcept { return card != nullptr; }                                   ///< [main thread]
    const OpenedFormat& format() const noexcept { return opened; }                             ///< the latest [main thread]
    const std::optional<Message>& trouble() const noexcept { return said; }                    ///< why it cannot be taken again [main thread]
    std::uint64_t blocks() const noexcept { return count.load (std::memory_order_acquire); }   ///< [any thread]
    std::uint64_t xruns() const noexcept { return before + (card ? card->xruns() : 0); }       ///< [main thread]
    std::uint64_t departures() const noexcept { return gone; }                                 ///< [main thread]

private:
    void begin (const OpenedFormat&) override;
    void block (const float* const*, int, float* const*, int, int) noexcept override;
    std::optional<Message> tryAgain (Clock::time_point);

    CardSystem& system;
    CardUser& user;
    CardWanted wanted;
    int outputs = 0, inputs = 0;
    bool is_wanted = false;
    OpenedFormat opened;
    std::optional<Message> said;
    std::uint64_t before = 0, gone = 0, seen = 0;
    Clock::time_point last {}, tried {};
    Clock::duration pause = retry_after;
    std::atomic<std::uint64_t> count = 0;
    std::unique_ptr<OpenCard> card;   // last: it calls this
};

}   // namespace tactus::host::audio
