// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/plan/plan.hpp>
#include <host/io/csv.hpp>
#include <host/io/wav.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// Writes what a run records: a row or frame per tick into each file, or CSV to the standard output if there is none.
/// Of taps that have several samples a tick, a CSV has the last; a WAV has all, if all taps have as many.
/// Files appear on commit() or not at all. What is wrong from the start ends the command with a message; a file that cannot
/// be written on is given up, and the others go on.
class Recorder
{
public:
    Recorder (const std::vector<std::string>& files, const std::vector<Tap>&, double rate_hz, bool to_standard_output);

    /// How many numbers there are to a tick.
    std::size_t width() const noexcept { return taps * per_tick; }

    /// Takes down what stands on the taps, those of the first plan or of one that followed, after a tick. [tick thread]
    void note (const std::vector<Tap>&, std::span<double> values) const noexcept;

    /// What was noted at a tick. If some before it are missing, a WAV holds the last values until then, so that it keeps time.
    /// Returns why files are given up: mostly nothing.
    std::vector<Error> frame (std::uint64_t tick, std::span<const double> values);
    std::vector<Error> commit();

private:
    tl::expected<void, Error> add (WavWriter&, std::uint64_t tick, std::span<const double> values);

    double rate_hz;
    std::size_t taps, per_tick = 1;   // samples of each
    std::uint64_t next = 0;           // tick
    std::vector<double> held;         // what came last
    bool print = false;
    std::vector<TableWriter> tables;
    std::vector<WavWriter> waves;
    std::vector<double> row;
};

}   // namespace tactus::host
