// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/node/catalogue.hpp>

#include <juce_audio_processors/juce_audio_processors.h>

#include <utility>

namespace tactus::bench
{

/// The boilerplate of an AudioProcessor: no MIDI, no programs, no editor, no state.
class PlainProcessor : public juce::AudioProcessor
{
public:
    PlainProcessor (int channels_in, int channels_out) : AudioProcessor (buses (channels_in, channels_out)) {}

    const juce::String getName() const override { return {}; }
    void prepareToPlay (double, int) override {}
    void releaseResources() override {}
    bool supportsDoublePrecisionProcessing() const override { return true; }
    using AudioProcessor::processBlock;
    void processBlock (juce::AudioBuffer<float>&, juce::MidiBuffer&) override {}
    double getTailLengthSeconds() const override { return 0.0; }
    bool acceptsMidi() const override { return false; }
    bool producesMidi() const override { return false; }
    juce::AudioProcessorEditor* createEditor() override { return nullptr; }
    bool hasEditor() const override { return false; }
    int getNumPrograms() override { return 1; }
    int getCurrentProgram() override { return 0; }
    void setCurrentProgram (int) override {}
    const juce::String getProgramName (int) override { return {}; }
    void changeProgramName (int, const juce::String&) override {}
    void getStateInformation (juce::MemoryBlock&) override {}
    void setStateInformation (const void*, int) override {}

private:
    static BusesProperties buses (int channels_in, int channels_out)
    {
        BusesProperties all;
        if (channels_in > 0) all.addBus (true, "in", juce::AudioChannelSet::discreteChannels (channels_in));
        if (channels_out > 0) all.addBus (false, "out", juce::AudioChannelSet::discreteChannels (channels_out));
        return all;
    }
};

/// A node as an AudioProcessor, with one channel for each component of its ports, in the order of its datasheet.
template <Node N>
class KernelProcessor : public PlainProcessor
{
public:
    explicit KernelProcessor (N n) : PlainProcessor (componentsOf<Role::input> (n), componentsOf<Role::output> (n)), node (std::move (n)) {}

    using PlainProcessor::processBlock;
    void processBlock (juce::AudioBuffer<double>& buffer, juce::MidiBuffer&) override
    {
        const auto in = detail::NodeAdapter<N>::gather (node, buffer.getArrayOfReadPointers());
        if constexpr (Peekable<N>)
        {
            latest = node.peek();
            node.tick (in);
        }
        else
            latest = node.tick (in);

        auto* const* channel = buffer.getArrayOfWritePointers();
        const auto give = [&] (const auto& row) {
            if constexpr (std::remove_cvref_t<decltype (row)>::role == Role::output)
            {
                const auto& value = latest.*row.member;
                if constexpr (std::is_same_v<std::remove_cvref_t<decltype (value)>, Vec3>)
                    for (int i = 0; i < 3; ++i)
                        **channel++ = value[i];
                else
                    **channel++ = value;
            }
        };
        std::apply ([&] (const auto&... row) { (give (row), ...); },
                    N::ports);
    }

    const N& kernel() const noexcept { return node; }
    const typename N::Outputs& last() const noexcept { return latest; }

private:
    template <Role role>
    static int componentsOf (const N& n)
    {
        int components = 0;
        const auto count = [&] (const auto& row) {
            using R = std::remove_cvref_t<decltype (row)>;
            using Shape = detail::Shape<typename R::Value>;
            if constexpr (R::role == role) components += Shape::width * (Shape::list ? detail::listSize (n) : 1);
        };
        std::apply ([&] (const auto&... row) { (count (row), ...); },
                    N::ports);
        return components;
    }

    N node;
    typename N::Outputs latest;
};

}   // namespace tactus::bench
