// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/command_line/command.hpp>

#include <string>
#include <utility>

namespace tactus::host
{

/// The size of a figure on paper, and its resolution.
struct FigureSize
{
    int width = 1600, height = 0;   ///< in pixels; a height of 0 depends on the number of panels
    double dpi = 0.0;               ///< as in Figure

    /// Adds --size and --dpi.
    std::pair<Option, Option> addSize (const Command&);

    /// Computes the size from the options. Throws UsageError.
    void readSize();

private:
    std::string size;
    double dots_per_inch = 192.0;
};

}   // namespace tactus::host
