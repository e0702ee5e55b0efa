// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>
#include <host/app/model/document.hpp>
#include <host/app/problems/fixes.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace tactus::host
{

/// What is wrong with the graph, and what is only worth a warning: each in words, with its remedy, and where a remedy is
/// plain, with a button that applies it. A click on one shows where it is.
class ProblemList final : public juce::Component
{
public:
    explicit ProblemList (Document&);
    ~ProblemList() override;

    void show (const Messages&);
    std::size_t count() const noexcept { return shown.size(); }

    std::function<void (const Culprit&)> onShow;

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    class Row;

    Document& document;
    Messages shown;
    bool asked = false;   // whether anything was shown yet
    juce::Viewport scroll;
    juce::Component column;
    std::vector<std::unique_ptr<Row>> rows;
};

}   // namespace tactus::host
