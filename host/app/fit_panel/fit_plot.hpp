// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/fit/fit_report.hpp>

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// Plots the recording and the fit in the same axes.
class FitPlot final : public juce::Component
{
public:
    FitPlot();

    void show (FitPicture);   ///< an empty picture shows nothing
    const FitPicture& shown() const noexcept { return picture; }

    void paint (juce::Graphics&) override;

private:
    FitPicture picture;
};

}   // namespace tactus::host
