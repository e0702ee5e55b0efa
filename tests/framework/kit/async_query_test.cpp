// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/run/log/replayed_queries.hpp>
#include <tactus/run/query_thread.hpp>

#include "support/no_allocation.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <deque>
#include <limits>

using namespace tactus;

namespace
{
using Question = long long;   // the tick on which the question is asked
using Answer = long long;
using Slow = AsyncQuery<Question, Answer>;

Answer square (const Question& q) { return q * q; }

/// Answers a question only when the gate is open for it.
struct Gate
{
    std::atomic<Question> open_to = -1;

    Answer operator() (const Question& q) const noexcept
    {
        while (q > open_to)
            std::this_thread::yield();
        return square (q);
    }
    void open() { open_to = std::numeric_limits<Question>::max(); }
};

/// Tells when the thread has completed another round, so that everything it had begun is done.
struct Rounds final : AsyncQueryBase
{
    std::atomic<int> count = 0;

    bool answer() noexcept override
    {
        ++count;
        return false;
    }
    void wait()
    {
        for (const int before = count; count < before + 2;)
            std::this_thread::yield();
    }
};

struct Run
{
    std::vector<std::optional<Answer>> answers;
    std::vector<std::uint64_t> late;
};

/// Records which answers were late, by the number of the call. With a single query, that is the tick.
struct Lateness final : Journal
{
    Lateness() { questions.reserve (20'000); }

    void tookOver (const Plan&) noexcept override {}
    void tightened (std::size_t, const GuardLimits&) noexcept override {}
    void turned (std::size_t, std::size_t, double) noexcept override {}
    void outdone (std::size_t, std::size_t) noexcept override {}
    void struck (std::size_t, std::size_t, double) noexcept override {}
    void late (std::uint64_t question) noexcept override { questions.push_back (question); }
    void halted() noexcept override {}
    void passed (double) noexcept override {}
    void resumed() noexcept override {}
    void emergency() noexcept override {}
    void rearmed() noexcept override {}
    void ticked (const Plan&) noexcept override {}

    std::vector<std::uint64_t> questions;
};

std::vector<bool> asksFrom (const std::vector<int>& dice)
{
    std::vector<bool> asks;
    for (const int d : dice)
        asks.push_back (d != 0);
    return asks;
}

std::optional<Question> asked (const std::vector<bool>& asks, std::size_t k) { return asks[k] ? std::optional (static_cast<Question> (k)) : std::nullopt; }

void checkAnswers (const std::vector<bool>& asks, const Run& run, int ticks, std::size_t stream, std::size_t streams)
{
    for (std::size_t k = 0; k < asks.size(); ++k)
        if (const auto& answer = run.answers[k * streams + stream])
        {
            RC_ASSERT (k >= static_cast<std::size_t> (ticks));
            const auto then = k - static_cast<std::size_t> (ticks);
            RC_ASSERT (asks[then]);
            RC_ASSERT (*answer == square (static_cast<Question> (then)));
        }
}
}   // namespace

TEST_CASE ("without a thread, a question is answered after exactly the given number of ticks, and nothing is late", "[slow]")
{
    test::property ("any questions", [] {
        const int ticks = *rc::gen::inRange (1, 9);
        const auto asks = asksFrom (*rc::gen::container<std::vector<int>> (rc::gen::inRange (0, 3)));
        Slow slow { square, ticks, nullptr };
        for (std::size_t k = 0; k < asks.size(); ++k)
        {
            const auto answer = slow (asked (asks, k));
            const auto then = static_cast<long long> (k) - ticks;
            const bool due = then >= 0 && asks[static_cast<std::size_t> (then)];
            RC_ASSERT (answer == (due ? std::optional (square (then)) : std::nullopt));
        }
    });
}

TEST_CASE ("with a thread that is on time, the answers are the same", "[slow]")
{
    QueryThread thread;
    Rounds rounds;
    Slow with { square, 3, &thread }, without { square, 3, nullptr };
    thread.add (rounds);
    std::vector<bool> asks;
    for (int k = 0; k < 100; ++k)
        asks.push_back (k % 3 != 1);
    for (Question k = 0; k < 100; ++k)
    {
        const auto ask = asked (asks, static_cast<std::size_t> (k));
        CHECK (with (ask) == without (ask));
        rounds.wait();
    }
    thread.remove (rounds);
    CHECK (thread.lateTicks() == 0);
}

TEST_CASE ("a late answer is dropped, and its slot stays occupied until the answer is ready", "[slow]")
{
    QueryThread thread;
    Lateness lateness;
    thread.report (lateness);
    Gate gate;
    Rounds rounds;
    Slow slow { std::ref (gate), 3, &thread };
    thread.add (rounds);

    Run run;
    for (Question k = 0; k < 14; ++k)
    {
        if (k == 8)
        {
            gate.open();
            rounds.wait();
        }
        run.answers.push_back (slow (k));
        if (k >= 8) rounds.wait();
    }
    thread.remove (rounds);

    // The questions of ticks 0, 1 and 2 occupy all slots until tick 8; by then, their answers are no longer wanted.
    CHECK (lateness.questions == std::vector<std::uint64_t> { 3, 4, 5, 6, 7 });
    CHECK (thread.lateTicks() == 5);
    for (std::size_t k = 0; k < 11; ++k)
        CHECK_FALSE (run.answers[k]);
    CHECK (run.answers[11] == 64);
    CHECK (run.answers[12] == 81);
    CHECK (run.answers[13] == 100);
}

TEST_CASE ("a run with several queries can be repeated exactly from the record of its late answers", "[slow]")
{
    int late_runs = 0, answered_runs = 0;
    test::property ("any late answers", [&] {
        const auto lengths = *rc::gen::container<std::vector<int>> (3, rc::gen::inRange (1, 7));
        const auto asks = asksFrom (*rc::gen::container<std::vector<int>> (30, rc::gen::inRange (0, 4)));
        const auto lags = *rc::gen::container<std::vector<Question>> (asks.size(), rc::gen::inRange<Question> (0, 8));
        const auto ask = [&] (std::deque<Slow>& streams, std::size_t k, Run& run) {
            for (auto& slow : streams)
                run.answers.push_back (slow (asked (asks, k)));
        };

        Run live;
        {
            QueryThread thread;
            Lateness lateness;
            thread.report (lateness);
            Gate gate;
            Rounds rounds;
            std::deque<Slow> streams;
            for (const int ticks : lengths)
                streams.emplace_back (std::ref (gate), ticks, &thread);
            thread.add (rounds);
            for (std::size_t k = 0; k < asks.size(); ++k)
            {
                gate.open_to = std::max (gate.open_to.load(), static_cast<Question> (k) - lags[k]);
                if (lags[k] <= 0) rounds.wait();
                ask (streams, k, live);
            }
            live.late = lateness.questions;
            RC_ASSERT (thread.lateTicks() == live.late.size());
            gate.open();
            thread.remove (rounds);
        }
        late_runs += live.late.empty() ? 0 : 1;
        answered_runs += std::ranges::any_of (live.answers, [] (const auto& a) { return a.has_value(); }) ? 1 : 0;

        Run again;
        ReplayedQueries repeated;
        repeated.repeat (live.late);
        std::deque<Slow> streams;
        for (const int ticks : lengths)
        {
            checkAnswers (asks, live, ticks, streams.size(), lengths.size());
            streams.emplace_back (square, ticks, &repeated);
        }
        for (std::size_t k = 0; k < asks.size(); ++k)
            ask (streams, k, again);
        RC_ASSERT (again.answers == live.answers);
    });
    CHECK (late_runs > 3);
    CHECK (answered_runs > 3);
}

TEST_CASE ("asking allocates nothing and takes no lock, no matter how many ticks are late", "[slow]")
{
    if (! NoAllocation::watches)
    {
        WARN ("skipped: a sanitizer has its own allocator");
        return;
    }
    QueryThread thread;
    Lateness lateness;
    thread.report (lateness);
    Gate gate;
    Slow slow { std::ref (gate), 2, &thread }, alone { square, 2, nullptr };
    int allocations = 0, locks = 0;
    {
        const NoAllocation watch;
        for (Question k = 0; k < 10'000; ++k)
        {
            slow (k);
            alone (k);
        }
        allocations = watch.allocations();
        locks = watch.locks();
    }
    gate.open();
    CHECK (allocations == 0);
    CHECK (locks == 0);
    CHECK (lateness.questions.size() == 9'998);
    CHECK (thread.lateTicks() == 9'998);
}

TEST_CASE ("a query can be created and destroyed while another one keeps the thread busy", "[slow]")
{
    struct Busy final : AsyncQueryBase
    {
        std::atomic<long long> answered = 0;
        bool answer() noexcept override
        {
            test::busyFor (std::chrono::microseconds (300));
            ++answered;
            return true;
        }
    };
    QueryThread thread;
    Busy busy;
    thread.add (busy);

    long long longest = 0;
    for (int i = 0; i < 20; ++i)
    {
        const auto before = busy.answered.load();
        while (busy.answered == before)
            std::this_thread::yield();
        Rounds other;
        const auto from = busy.answered.load();
        thread.add (other);
        longest = std::max (longest, busy.answered - from);
        thread.remove (other);
    }
    thread.remove (busy);
    CHECK (longest <= 2);   // the current round, and one that began in the meantime
}

TEST_CASE ("a query may be destroyed right after its last question", "[slow]")
{
    QueryThread thread;
    for (int i = 0; i < 200; ++i)
    {
        Slow slow { square, 2, &thread };
        for (Question k = 0; k < i % 5; ++k)
            slow (k);
    }
    SUCCEED();
}
