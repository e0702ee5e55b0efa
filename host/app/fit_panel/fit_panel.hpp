// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fit_columns.hpp"
#include "fit_plot.hpp"
#include "fit_table.hpp"

#include <host/app/look/plain_button.hpp>
#include <host/app/run/job.hpp>
#include <host/app/text/filled.hpp>

#include <functional>

namespace tactus::host
{

/// A panel over the window that shows a recording and a model fitted to it: the kind of recording, a plot of both, the parameters with intervals,
/// and the verdict. Nothing changes until the user accepts the fit. [main thread]
class FitPanel final : public juce::Component, public juce::TooltipClient
{
public:
    FitPanel();

    /// Opens the panel and fits the kind that the columns suggest. A file that cannot be read is reported in the panel.
    void open (const std::filesystem::path&);
    void close();   ///< closes the panel, and cancels a running fit; changes nothing
    bool isOpen() const { return isVisible(); }

    void poll();   ///< call many times a second

    void choose (FitKind);   ///< chooses a kind, as the list does
    FitColumns& columns() noexcept { return which; }
    void setAmount (const juce::String&);   ///< sets the amount, as if the user typed it: "2 N"
    bool isFitting() const { return job.isRunning(); }
    const std::optional<FittedGraph>& fitted() const noexcept { return result; }
    juce::String problem() const { return failure; }   ///< why there is no fit; empty if there is one
    std::optional<FitKind> kind() const noexcept { return chosen; }

    void acceptAsGraph();
    void acceptIntoGraph();

    std::function<void (const FittedGraph&)> onOpenGraph;   ///< opens a fit, and closes the panel once the graph is open: the user may yet cancel
    std::function<void (const FittedGraph&)> onInsert;      ///< called when the panel has closed

    void paint (juce::Graphics&) override;
    void resized() override;
    bool keyPressed (const juce::KeyPress&) override;
    juce::String getTooltip() override;   ///< the path of the recording, over the heading

private:
    bool isLow() const { return getHeight() < 420; }
    juce::Rectangle<int> inner() const;   ///< of the box
    juce::Rectangle<int> headingArea() const;
    void fit();
    void fail (const std::string&);
    void readAmount();
    void showResult();

    std::shared_ptr<const Table> table;
    std::filesystem::path file;
    std::optional<FitKind> chosen;
    Job<FittedGraph, FitCourse> job;
    std::optional<FittedGraph> result;
    juce::String failure;

    juce::ComboBox kinds;
    FitColumns which;
    juce::Label amount_label;
    juce::TextEditor amount;
    FitPlot plot;
    FitTable values;
    juce::Viewport scroll;
    PlainButton as_graph { TRANS ("Open as new graph") }, into_graph { TRANS ("Add to this graph") }, cancel { TRANS ("Cancel") };
    juce::Rectangle<int> box;
};

}   // namespace tactus::host
