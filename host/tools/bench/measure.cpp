// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>

namespace tactus::bench
{

namespace
{
bool sameBits (double a, double b) { return std::bit_cast<std::uint64_t> (a) == std::bit_cast<std::uint64_t> (b); }

class Silent : public benchmark::BenchmarkReporter
{
    bool ReportContext (const Context&) override { return true; }
    void ReportRuns (const std::vector<Run>&) override {}
};

double secondsOf (const std::function<void (int)>& work, int round)
{
    const auto start = std::chrono::steady_clock::now();
    work (round);
    return std::chrono::duration<double> (std::chrono::steady_clock::now() - start).count();
}

void run (Pair& pair, benchmark::State& state)
{
    int round = 0;
    for ([[maybe_unused]] auto iteration : state)
    {
        double first = 0.0, second = 0.0;
        const auto timeFirst = [&] {
            if (pair.prepare) pair.prepare (round);
            first = secondsOf (pair.first, round);
        };
        if (round % 2 == 0) timeFirst();
        second = secondsOf (pair.second, round);
        if (round % 2 != 0) timeFirst();
        pair.first_s.push_back (first / pair.first_work);
        pair.second_s.push_back (second / pair.second_work);
        state.SetIterationTime (first + second);
        ++round;
    }
    const auto slash = pair.name.find ('/');
    const auto time = [] (const std::vector<double>& seconds) { return benchmark::Counter (medianOf (seconds)); };
    state.counters[pair.name.substr (0, slash) + "_s"] = time (pair.first_s);
    state.counters[pair.name.substr (slash + 1) + "_s"] = time (pair.second_s);
}
}   // namespace

Agreement compare (const Contest& contest)
{
    const auto first = contest.make_first(), second = contest.make_second();
    Agreement found { .agree = true };
    for (const auto& row : contest.inputs)
    {
        first->tick (row.data());
        second->tick (row.data());
        const auto a = first->outputs(), b = second->outputs();
        found.agree = found.agree && a.size() == b.size();
        for (std::size_t i = 0; i < std::min (a.size(), b.size()); ++i, ++found.values)
        {
            const double apart = std::abs (a[i] - b[i]);
            found.worst = std::max (found.worst, apart);
            found.agree = found.agree && (contest.tolerance > 0.0 ? apart <= contest.tolerance : sameBits (a[i], b[i]));
        }
    }
    return found;
}

Ratio ratioOf (std::vector<double> rounds)
{
    std::ranges::sort (rounds);
    const auto n = static_cast<double> (rounds.size());
    const auto at = [&] (double rank) { return rounds[static_cast<std::size_t> (std::clamp (rank, 0.0, n - 1.0))]; };

    const double spread = 0.5 * 1.96 * std::sqrt (n);   // half the confidence interval, in rounds
    return { .median = medianOf (rounds), .low = at (std::floor (0.5 * n - spread)), .high = at (std::ceil (0.5 * n + spread) - 1.0) };
}

double medianOf (std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t> (values.size() / 2);
    std::ranges::nth_element (values, middle);
    return *middle;
}

Ratio Pair::ratio() const
{
    std::vector<double> ratios;
    for (std::size_t i = 0; i < first_s.size(); ++i)
        ratios.push_back (first_s[i] / second_s[i]);
    return ratioOf (std::move (ratios));
}

void measure (std::vector<std::unique_ptr<Pair>>& pairs, bool quiet)
{
    for (auto& pair : pairs)
        benchmark::RegisterBenchmark (pair->name.c_str(), [&pair = *pair] (benchmark::State& state) { run (pair, state); })
            ->UseManualTime()
            ->Iterations (pair->rounds)
            ->Unit (benchmark::kMicrosecond);

    Silent silent;
    quiet ? benchmark::RunSpecifiedBenchmarks (&silent) : benchmark::RunSpecifiedBenchmarks();
    benchmark::ClearRegisteredBenchmarks();
}

}   // namespace tactus::bench
