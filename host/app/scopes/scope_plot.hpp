// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_ports.hpp"
#include "tool_picture.hpp"

#include <host/app/look/look.hpp>

namespace tactus::host
{

/// Where values are drawn, and which.
struct Lane
{
    juce::Rectangle<float> area;
    Extent x, y;
    std::string unit, x_unit;
    bool is_logarithmic = false;           ///< along x
    bool shows_x = true, shows_y = true;   ///< the numbers below, and beside

    juce::Point<float> toPixels (double at_x, double at_y) const noexcept;
    double xAt (float pixel) const noexcept;
    double yAt (float pixel) const noexcept;
};

/// What the scopes of a panel share.
struct ScopeDesk
{
    std::vector<ScopePort> ports;        ///< that can be probed
    std::vector<std::string> energies;   ///< those of them that are energies
    std::function<void()> onChange;      ///< another port is wanted, or one less
};

/// The drawing of a scope: lanes with their scales, two cursors, the wheel.
class ScopePlot : public juce::Component
{
public:
    /// Something in the header that can be clicked.
    struct Action
    {
        juce::String text, about;
        std::function<void (juce::Component& below)> onClick;
    };

    ScopePlot (ScopeSpec&, ScopeDesk&);

    /// Takes in what stands on the ports now.
    virtual void show (const Signals&) = 0;

    virtual std::vector<Action> actions() { return {}; }

    /// What it has made itself, to be written with what it reads.
    virtual TraceList made() const { return {}; }

    const std::vector<Lane>& shownLanes() const noexcept { return lanes; }

    void paint (juce::Graphics&) final;
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;
    void mouseDoubleClick (const juce::MouseEvent&) override;
    void mouseWheelMove (const juce::MouseEvent&, const juce::MouseWheelDetails&) override;

protected:
    static constexpr float gutter = 44.0f, foot = 18.0f, legend_height = 16.0f;

    virtual void paintLane (juce::Graphics&, const Lane&, std::size_t index) = 0;
    virtual void paintOver (juce::Graphics&) {}
    virtual juce::String emptyWords() const = 0;
    virtual void zoomX (double factor, const Lane&, float at);

    /// Lanes one below the other, that share the abscissa.
    void layOut (const std::vector<std::string>& units);
    Extent rangeOf (const std::string& unit, const Extent& seen);

    /// "■ stuck": small squares of colour and words, at an end of a line.
    struct Entry
    {
        juce::Colour colour;
        juce::String text;
    };
    void paintLegend (juce::Graphics&, juce::Rectangle<float>, const std::vector<Entry>&, bool at_right = true) const;

    /// One below the other at the top right of a lane.
    void paintReadout (juce::Graphics&, const juce::StringArray&, juce::Rectangle<float>) const;

    const Theme& theme() const { return themeOf (*this); }

    ScopeSpec& spec;
    ScopeDesk& desk;
    std::vector<Lane> lanes;

private:
    std::size_t laneAt (juce::Point<float>) const;
    void paintScales (juce::Graphics&, const Lane&) const;
    void paintCursors (juce::Graphics&) const;

    std::map<std::string, AutoRange> ranges;
    bool dragged = false;
};

/// The colour of a component of the n-th port of a quantity: the first is the quantity's own, components differ in light.
juce::Colour traceColour (const Theme&, Quantity, std::size_t nth_port, std::size_t component);

/// A list of all ports that can be probed, by node, to choose from.
void choosePort (juce::Component& below, const std::vector<ScopePort>&, std::function<void (const std::string&)>);

std::unique_ptr<ScopePlot> makePlot (ScopeSpec&, ScopeDesk&);

}   // namespace tactus::host
