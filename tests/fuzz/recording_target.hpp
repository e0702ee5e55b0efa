// SPDX-License-Identifier: MIT
#pragma once

#include "whole_error.hpp"

#include <host/tools/fitting/fitting.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

namespace tactus::fuzz
{

/// Reads the bytes as a recording, and fits each kind whose columns it has. Either there is a fit with a preset, or an error. Aborts otherwise.
inline void tryRecording (std::string_view bytes)
{
    const auto file = std::filesystem::temp_directory_path() / ("tactus_fuzz_" + std::to_string (::getpid()) + ".csv");
    std::ofstream (file, std::ios::binary) << bytes;
    const auto table = host::readRecording (file);
    std::filesystem::remove (file);
    if (! table) return checkWhole (table.error());
    static_cast<void> (host::guessKind (*table));
    constexpr std::size_t most_rows = 400, most_rows_of_slow_fits = 100;
    if (table->rows() > most_rows) return;
    for (const auto& info : host::fitKinds())
    {
        const bool is_slow = info.kind == host::FitKind::friction || info.kind == host::FitKind::modes;
        if (is_slow && table->rows() > most_rows_of_slow_fits) continue;
        const auto made = host::fitRecording (info.kind, *table, "fuzz.csv", {});
        if (! made)
        {
            checkWhole (made.error());
            continue;
        }
        if (made->preset.root.nodes.empty() || made->report.rows == 0) std::abort();
        for (const auto& v : made->report.values)
            if (std::isnan (v.value) || v.low > v.value || v.high < v.value) std::abort();
        if (made->report.is_good && ! std::isfinite (made->report.residual)) std::abort();
    }
}

}   // namespace tactus::fuzz
