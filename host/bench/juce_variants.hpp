// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "juce_graph.hpp"
#include "kernels.hpp"
#include "variant.hpp"

#include <nodes/filter/one_pole.hpp>

namespace tactus::bench
{

template <Node N>
class KernelProcessor;

/// The reference graph in JUCE.
class JuceReference : public Variant
{
public:
    JuceReference();

    void tick (const double* in) noexcept override;
    std::vector<double> outputs() const override;

private:
    DeviceState device;
    const nodes::DeviceForce* motor = nullptr;
    std::unique_ptr<JuceGraph> graph;
};

/// A graph of one-poles (one_poles.hpp) in JUCE.
class JuceOnePoles : public Variant
{
public:
    explicit JuceOnePoles (const graph::Graph&);

    void tick (const double* in) noexcept override { graph->tick (*in); }
    std::vector<double> outputs() const override;
    void edit() { graph->edit(); }

private:
    std::vector<const KernelProcessor<nodes::OnePole>*> ends;
    std::unique_ptr<JuceGraph> graph;
};

}   // namespace tactus::bench
