// SPDX-License-Identifier: MIT
#pragma once

/// Slow questions: what a node would like to know but cannot work out within a tick, such as which patch of a large mesh
/// is near. A question asked on tick k is answered on tick k + `ticks`, never earlier and never later, so that every run
/// of the same inputs gives the same bits.
///
/// Live, a SlowAnswers thread works the answers out. One that is not ready when it is due is dropped, and as long as its
/// question is still being worked on, no other takes its place: such a tick is *late*, and is kept for the record.
/// Without a thread, as when rendering, answers are worked out when they are due.

#include <atomic>
#include <concepts>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

namespace tactus
{

/// Somebody with questions: what the answering thread sees of a SlowQuestion.
class Asker
{
public:
    virtual ~Asker() = default;

    /// Answers all that is open. True if there was something. [answering thread]
    virtual bool answer() noexcept = 0;
};

/// The thread that answers. Nothing here is called on the tick thread.
class SlowAnswers
{
public:
    SlowAnswers();
    ~SlowAnswers();
    SlowAnswers (const SlowAnswers&) = delete;
    SlowAnswers& operator= (const SlowAnswers&) = delete;

    void add (Asker&);      // [main thread]
    void remove (Asker&);   // [main thread] waits until nothing of this asker is being answered

    void noteLate() noexcept { late_ticks.fetch_add (1, std::memory_order_relaxed); }                  // [tick thread]
    std::uint64_t lateTicks() const noexcept { return late_ticks.load (std::memory_order_relaxed); }   ///< of all askers together [any thread]

private:
    void run();
    std::unique_lock<std::mutex> turn();

    std::mutex guard;   // of askers
    std::condition_variable woken;
    std::atomic<int> waiting = 0;
    std::vector<Asker*> askers;
    std::atomic<bool> stopping = false;
    std::atomic<std::uint64_t> late_ticks = 0;
    std::thread thread;
};

/// One stream of questions, at most one a tick. Question and Answer are small and copied.
template <std::default_initializable Question, std::default_initializable Answer>
class SlowQuestion final : public Asker
{
public:
    /// `how` must be noexcept, and give the same answer to the same question. `ticks` is at least 1. [main thread]
    SlowQuestion (std::function<Answer (const Question&)> how_, int ticks, SlowAnswers* by) : how (std::move (how_)), slots (static_cast<std::size_t> (ticks)), answers (by)
    {
        late_ticks.reserve (late_capacity);
        if (answers) answers->add (*this);
    }

    ~SlowQuestion() override
    {
        if (answers) answers->remove (*this);
    }

    SlowQuestion (const SlowQuestion&) = delete;
    SlowQuestion& operator= (const SlowQuestion&) = delete;

    /// The answer to what was asked `ticks` ago, if something was and it is not late; and asks what is to be answered
    /// `ticks` from now. To be called once each tick. [tick thread]
    std::optional<Answer> operator() (const std::optional<Question>& next) noexcept
    {
        auto& slot = slots[static_cast<std::size_t> (now % slots.size())];
        std::optional<Answer> due;
        if (isLate (slot))
            noteLate();
        else
        {
            const State state = slot.state.load (std::memory_order_acquire);
            if (! slot.dropped && state == State::answered) due = slot.answer;
            if (! slot.dropped && state == State::asked) due = how (slot.question);   // there is no thread
            slot.dropped = false;
            slot.state.store (State::empty, std::memory_order_relaxed);
            if (next)
            {
                slot.question = *next;
                slot.state.store (State::asked, std::memory_order_release);
            }
        }
        ++now;
        return due;
    }

    /// The late ticks so far, the first 4096 of them. [tick thread, or after it]
    std::span<const std::uint64_t> lateTicks() const noexcept { return late_ticks; }

    /// Makes these ticks late, and no others: an earlier run is repeated. Only without a thread, before the first tick.
    void repeat (std::vector<std::uint64_t> late) { to_repeat = std::move (late); }

    bool answer() noexcept override
    {
        bool any = false;
        for (auto& slot : slots)
            if (slot.state.load (std::memory_order_acquire) == State::asked)
            {
                slot.answer = how (slot.question);
                slot.state.store (State::answered, std::memory_order_release);
                any = true;
            }
        return any;
    }

private:
    enum class State
    {
        empty,
        asked,
        answered
    };

    struct Slot
    {
        std::atomic<State> state = State::empty;
        Question question {};
        Answer answer {};
        bool dropped = false;   // was late: what comes of it is not wanted any more   [tick thread]
    };

    bool isLate (Slot& slot) noexcept
    {
        if (answers) return slot.state.load (std::memory_order_acquire) == State::asked;
        return next_repeat < to_repeat.size() && to_repeat[next_repeat] == now;
    }

    void noteLate() noexcept
    {
        slots[static_cast<std::size_t> (now % slots.size())].dropped = true;
        if (late_ticks.size() < late_capacity) late_ticks.push_back (now);
        if (answers) answers->noteLate();
        if (next_repeat < to_repeat.size()) ++next_repeat;
    }

    static constexpr std::size_t late_capacity = 4096;

    std::function<Answer (const Question&)> how;
    std::vector<Slot> slots;
    SlowAnswers* answers;
    std::uint64_t now = 0;
    std::vector<std::uint64_t> late_ticks, to_repeat;
    std::size_t next_repeat = 0;
};

}   // namespace tactus
