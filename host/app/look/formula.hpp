// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// A piece of a formula on one level.
struct FormulaRun
{
    enum class Level
    {
        base,
        raised,
        lowered
    };

    std::string text;
    Level level = Level::base;

    bool operator== (const FormulaRun&) const = default;
};

/// A formula as the doc comments of nodes write it, as runs: `mu f_n / d_max` becomes μ f, a lowered n, / d, a lowered max. Names of params,
/// such as break_away, stay as they are, and so do words.
std::vector<FormulaRun> typeset (std::string_view);

}   // namespace tactus::host
