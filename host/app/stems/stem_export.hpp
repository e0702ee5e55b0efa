// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/desk/desk.hpp>
#include <host/app/run/job.hpp>
#include <host/tools/stems/stems.hpp>

namespace tactus::host
{

/// The export of stems from the window: asks for the kind of files and for a folder, and renders in the background. [main thread]
class StemExport
{
public:
    explicit StemExport (const Desk& d) : desk (d) {}

    void ask();
    void attend();   ///< shows the progress; call it many times a second
    bool isRunning() const noexcept { return job.isRunning(); }

private:
    void render (const graph::Graph&, const StemOptions&, const std::filesystem::path&);

    const Desk& desk;
    Job<WrittenStems> job;
    std::filesystem::path folder;
    juce::String title;   // of the question that offers to cancel
};

}   // namespace tactus::host
