// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stem_job.hpp"

#include <host/app/dialogs/question.hpp>

#include <functional>

namespace tactus::host
{

/// The export of stems from the window: asks for the kind of files and for a folder, and renders in the background. [main thread]
class StemExport
{
public:
    struct Window
    {
        Question& question;
        std::function<void (const juce::String&)> notify;
        std::function<void (const std::string& name, std::function<void (const std::filesystem::path&)>)> chooseFolder;
    };

    StemExport (const Catalogue& c, Window w) : catalogue (c), window (std::move (w)) {}

    void ask (const graph::Graph&);
    void attend();   ///< shows the progress; call it many times a second
    bool isRunning() const noexcept { return job.isRunning(); }

private:
    void render (const graph::Graph&, const StemOptions&, const std::filesystem::path&);

    const Catalogue& catalogue;
    Window window;
    StemJob job;
    std::filesystem::path folder;
    juce::String title;   // of the question that offers to cancel
};

}   // namespace tactus::host
