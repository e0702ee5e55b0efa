// SPDX-License-Identifier: MIT
#pragma once

/// Async queries: questions a node cannot answer within a tick, such as which patch of a large mesh is nearest. A question
/// asked on tick k is answered on tick k + `ticks`, never earlier and never later, so that every run of the same inputs
/// gives the same bits.
///
/// In a live run a QueryThread computes the answers. An answer that is not ready when it is due is dropped, and its slot takes no
/// other question until the thread has finished with it. Such a tick is *late*, and the journal records it. Without a thread, as
/// when rendering, answers are computed when they are due. ReplayedQueries repeats recorded lateness.

#include <tactus/kit/at.hpp>

#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace tactus
{

/// The part of an AsyncQuery that the answering thread sees.
class AsyncQueryBase
{
public:
    virtual ~AsyncQueryBase() = default;

    /// Answers all open questions. Returns true if there were any. [answering thread]
    virtual bool answer() noexcept = 0;
};

/// Answers the queries of a graph, and decides which answers are late.
class QueryService
{
public:
    QueryService() = default;
    virtual ~QueryService() = default;
    QueryService (const QueryService&) = delete;
    QueryService& operator= (const QueryService&) = delete;

    virtual void add (AsyncQueryBase&) = 0;      // [main thread]
    virtual void remove (AsyncQueryBase&) = 0;   // [main thread] on return, no question of this query is being answered

    /// Returns true if an answer that is due is late, given whether it is ready. Each query calls this once per tick, in the
    /// order in which the nodes tick. So call number n since the start, counted from 0, is the same call in a repeated run;
    /// the journal records that number. [tick thread]
    virtual bool isLate (bool ready) noexcept = 0;
};

/// A stream of questions, at most one per tick. Question and Answer should be small: they are copied.
template <std::default_initializable Question, std::default_initializable Answer>
class AsyncQuery final : public AsyncQueryBase
{
public:
    /// `how` must be noexcept, and always give the same answer to the same question. `ticks` is at least 1. [main thread]
    AsyncQuery (std::function<Answer (const Question&)> how_, int ticks, QueryService* by)
        : how (std::move (how_)), slots (at (ticks)), answers (by)
    {
        if (answers) answers->add (*this);
    }

    ~AsyncQuery() override
    {
        if (answers) answers->remove (*this);
    }

    AsyncQuery (const AsyncQuery&) = delete;
    AsyncQuery& operator= (const AsyncQuery&) = delete;

    /// Returns the answer to the question asked `ticks` ago, if there was one and its answer is not late. Asks the question
    /// that must be answered in `ticks` ticks. Call it once per tick. [tick thread]
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
        if (! slot.dropped && state == State::asked) due = how (slot.question);   // without a thread, answers are computed now
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

    /// The open questions: an answer follows from its question. While another thread answers them, there is no moment at which nothing is under way.
    void serialize (auto& archive)
    {
        if (answers) return archive.refuse ("is searched on another thread, which cannot be saved; set its search_ticks to 0");
        archive.expect (slots.size());
        archive.index (now, slots.size());
        for (auto& slot : slots)
        {
            bool is_asked = slot.state.load (std::memory_order_relaxed) != State::empty;
            archive (is_asked, slot.question, slot.dropped);
            slot.state.store (is_asked ? State::asked : State::empty, std::memory_order_relaxed);
        }
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
        bool dropped = false;   // the answer was late and is no longer wanted   [tick thread]
    };

    std::function<Answer (const Question&)> how;
    std::vector<Slot> slots;
    QueryService* answers;
    std::size_t now = 0;   // index of the slot of this tick
};

}   // namespace tactus
