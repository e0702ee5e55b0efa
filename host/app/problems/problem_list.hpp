// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fixes.hpp"

#include <host/app/look/look.hpp>
#include <host/app/model/document.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace tactus::host
{

/// The errors and warnings of the graph, and the limits of the devices that it breaks, each with its remedy and, if there is an
/// obvious fix, a button that applies it; if a file is missing, the button asks for it. A click on a message shows its location.
class ProblemList final : public juce::Component
{
public:
    explicit ProblemList (Document&);
    ~ProblemList() override;

    /// Remarks, about limits that are not judged, come last and do not count as problems. While the limits are being checked, an empty list says so.
    void show (const Messages&, const Messages& remarks = {}, bool is_checking = false);
    const Messages& messages() const noexcept { return shown; }

    std::function<void (const ProblemLocation&)> onShow;
    std::function<void (graph::Command)> onFix;          ///< carries out a fix
    std::function<void (const Message&)> onChooseFile;   ///< asks for the file that is missing, see missingFileOf()

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    class Row;

    Document& document;
    Messages shown, remarked;
    bool asked = false;   // true after the first show()
    bool is_checking = false;
    juce::Viewport scroll;
    juce::Component column;
    std::vector<std::unique_ptr<Row>> rows;
};

}   // namespace tactus::host
