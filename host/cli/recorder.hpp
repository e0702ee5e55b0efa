// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/plan/plan.hpp>
#include <host/io/csv.hpp>
#include <host/io/wav.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// Writes what a run records: a row or frame per tick into each file, or CSV to the standard output if there is none.
/// Files appear on commit() or not at all. Any failure ends the command with a message.
class Recorder
{
public:
    Recorder (const std::vector<std::string>& files, const std::vector<Tap>&, double rate_hz, bool to_standard_output);

    void frame (std::span<const double> values);
    void commit();

private:
    double rate_hz;
    std::size_t ticks = 0;
    bool print = false;
    std::vector<TableWriter> tables;
    std::vector<WavWriter> waves;
    std::vector<double> row;
};

}   // namespace tactus::host
