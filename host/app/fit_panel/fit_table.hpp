// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/text/filled.hpp>
#include <host/tools/fitting/fitting.hpp>

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// A text that begins with a capital letter and ends with a full stop.
juce::String sentence (const std::string&);

/// The verdict, the parameters with their intervals, the residuals and remarks. Its height depends on its content and its width.
class FitTable final : public juce::Component
{
public:
    FitTable() { setTitle (TRANS ("Fitted parameters")); }

    void show (const FittedGraph&);
    int heightFor (int width) const;

    void paint (juce::Graphics&) override;

private:
    struct Row
    {
        juce::String name, value, interval;
        bool is_main = true;
    };

    juce::TextLayout remarks (int width) const;
    std::pair<int, int> widths() const;
    bool isNarrow (int width) const;

    FitReport report;
    juce::StringArray details;
    std::vector<Row> rows;
};

}   // namespace tactus::host
