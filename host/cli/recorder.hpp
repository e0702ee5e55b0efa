// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/files/wav.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/plan/plan.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// Writes the recording of a run: one row or frame per tick into each file, or CSV to the standard output if there is no file. If taps have
/// several samples per tick, a CSV gets the last one; a WAV gets all of them if all taps have the same number. `all_samples` notes them
/// even if no file is a WAV. Files appear on commit(), or not at all; IfKilled says what becomes of them if the process is killed
/// before. Problems at the start end the command with a message. A file that cannot be written is given up, and writing of the other
/// files continues.
class Recorder
{
public:
    Recorder (const std::vector<std::string>& files, const std::vector<Tap>&, double rate_hz, bool to_standard_output, IfKilled = IfKilled::removed,
              bool all_samples = false);

    std::size_t samplesPerTick() const noexcept { return per_tick; }

    /// The number of values per tick.
    std::size_t width() const noexcept { return taps * per_tick; }

    /// Samples the taps of the current plan after a tick; that plan may be newer than the one at construction. [tick thread]
    void note (const std::vector<Tap>&, std::span<double> values) const noexcept;

    /// Writes the values of a tick. If earlier ticks are missing, a WAV repeats the last values, so that it keeps
    /// time. Returns the reasons why files were given up; usually none.
    std::vector<Message> frame (std::uint64_t tick, std::span<const double> values);

    /// Hands all ticks so far to the system; they then survive the end of the process. Returns the reasons why files were given up.
    std::vector<Message> flush();
    std::vector<Message> commit();

private:
    Result<> add (WavWriter&, std::uint64_t tick, std::span<const double> values);

    double rate_hz;
    std::size_t taps, per_tick = 1;   // per_tick: samples of each tap in a tick
    std::uint64_t next = 0;           // the tick after the last one written
    std::vector<double> held;         // values of the last tick; a WAV repeats them for missing ticks
    bool print = false;
    std::vector<TableWriter> tables;
    std::vector<WavWriter> waves;
    std::vector<double> row;
};

}   // namespace tactus::host
