// SPDX-License-Identifier: MIT
#pragma once

/// Slow questions: what a node would like to know but cannot work out within a tick, such as which patch of a large mesh
/// is near. A question asked on tick k is answered on tick k + `ticks`, never earlier and never later, so that every run
/// of the same inputs gives the same bits.
///
/// Live, an AnsweringThread works the answers out. One that is not ready when it is due is dropped, and as long as its
/// question is still being worked on, no other takes its place: such a tick is *late*, and a journal is told.
/// Without a thread, as when rendering, answers are worked out when they are due; RepeatedAnswers makes late what was.

#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
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

/// Who answers the slow questions of a graph, and says which answers are late.
class SlowAnswers
{
public:
    SlowAnswers() = default;
    virtual ~SlowAnswers() = default;
    SlowAnswers (const SlowAnswers&) = delete;
    SlowAnswers& operator= (const SlowAnswers&) = delete;

    virtual void add (Asker&) = 0;      // [main thread]
    virtual void remove (Asker&) = 0;   // [main thread] nothing of this asker is being answered any more

    /// Whether what is due is late, by whether it is ready. Each stream of questions asks once each tick, in the order in
    /// which its node ticks; so these calls, counted from 0 since the start, are the same ones in a run that is repeated,
    /// and their number is what the journal is told. [tick thread]
    virtual bool isLate (bool ready) noexcept = 0;
};

/// One stream of questions, at most one a tick. Question and Answer are small and copied.
template <std::default_initializable Question, std::default_initializable Answer>
class SlowQuestion final : public Asker
{
public:
    /// `how` must be noexcept, and give the same answer to the same question. `ticks` is at least 1. [main thread]
    SlowQuestion (std::function<Answer (const Question&)> how_, int ticks, SlowAnswers* by) : how (std::move (how_)), slots (static_cast<std::size_t> (ticks)), answers (by)
    {
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
        auto& slot = slots[now];
        now = now + 1 < slots.size() ? now + 1 : 0;

        const State state = slot.state.load (std::memory_order_acquire);
        if (answers && answers->isLate (state != State::asked))
        {
            slot.dropped = true;
            return std::nullopt;
        }
        std::optional<Answer> due;
        if (! slot.dropped && state == State::answered) due = slot.answer;
        if (! slot.dropped && state == State::asked) due = how (slot.question);   // there is no thread
        slot.dropped = false;
        slot.state.store (State::empty, std::memory_order_relaxed);
        if (next)
        {
            slot.question = *next;
            slot.state.store (State::asked, std::memory_order_release);
        }
        return due;
    }

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

    std::function<Answer (const Question&)> how;
    std::vector<Slot> slots;
    SlowAnswers* answers;
    std::size_t now = 0;   // the slot of this tick
};

}   // namespace tactus
