// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/text/filled.hpp>

#include <tactus/fit/fit_report.hpp>

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// The verdict, the parameters with their intervals, and the residuals. Its height depends on its content and its width.
class FitTable final : public juce::Component
{
public:
    FitTable() { setTitle (TRANS ("Fitted parameters")); }

    void show (FitReport);
    int heightFor (int width) const;

    void paint (juce::Graphics&) override;

private:
    struct Row
    {
        juce::String name, value, interval;
        bool is_main = true;
    };

    juce::TextLayout remarks (int width) const;

    FitReport report;
    std::vector<Row> rows;
};

}   // namespace tactus::host
