// SPDX-License-Identifier: GPL-3.0-or-later
#include "pair.hpp"

#include <benchmark/benchmark.h>

#include <chrono>

namespace tactus::bench
{

namespace
{
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
