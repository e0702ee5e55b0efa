// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/cli/run_options.hpp>
#include <host/tools/stems/stems.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// `tactus render --stems`.
struct StemCommand
{
    std::string folder;   ///< "": no stems
    std::string format, scale, loop;
    std::vector<std::string> clips;
    double rate_hz = 0.0;
    bool is_mono = false, has_no_dither = false;

    void addTo (const Command&);

    /// Renders the graph, or each graph of a folder into a folder with its name. Ends the command if one of them fails.
    void run (RunOptions) const;

private:
    StemOptions options() const;
};

}   // namespace tactus::host
