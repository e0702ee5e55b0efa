// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_ports.hpp"
#include "tool_picture.hpp"

#include <host/app/look/look.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

/// An area with axes in which values are drawn.
struct Lane
{
    juce::Rectangle<float> area;
    Extent x, y;
    std::string unit, x_unit;
    bool is_logarithmic = false;           ///< true if the x axis is logarithmic
    bool shows_x = true, shows_y = true;   ///< true if the numbers of the axis are drawn

    juce::Point<float> toPixels (double at_x, double at_y) const noexcept;
    double xAt (float pixel) const noexcept;
    double yAt (float pixel) const noexcept;
};

/// The data that all scopes of a panel share.
struct ScopeContext
{
    std::vector<ScopePort> ports;        ///< all ports that can be probed
    PortNames names;                     ///< of all these ports
    std::vector<std::string> energies;   ///< the ports that report energies; none if there are more than can be recorded
    std::size_t energies_left_out = 0;   ///< the number of these ports, if there are more than can be recorded
    double hand_delay = 0.0;             ///< of the hand's device, in ticks; 0 if it is not known
    bool leaves_out = false;             ///< some ports are not recorded, because the scopes ask for too many
    std::function<void()> onChange;      ///< called when the spec of a scope has changed
    std::uint64_t edits = 0;             ///< counts the changes of the ports
    std::uint64_t samples = 0;           ///< counts what the traces have received
};

/// The plot of a scope: lanes with axes, two cursors that read the nearest curve, and zoom with the wheel.
class ScopePlot : public juce::Component
{
public:
    /// A button in the header.
    struct Action
    {
        juce::String text, about;
        std::function<void (juce::Component& below)> onClick;
    };

    ScopePlot (ScopeSpec&, ScopeContext&);

    /// Updates the plot from the traces.
    virtual void show (const Signals&) = 0;

    virtual std::vector<Action> actions() { return {}; }

    /// Traces that the plot has computed, to be saved with those it reads.
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
    virtual juce::String emptyText() const = 0;
    virtual void zoomX (double factor, const Lane&, float at);

    /// The cursor on the curve that it reads, or on the nearest one. Where a curve covers several values, the nearest. Empty if the plot has no curve
    /// there, or no curves over x.
    virtual std::optional<Cursor> onCurve (const Cursor&) const { return {}; }

    /// Moves the cursors with their curves, of which the plot has so many. Where curves come or go, the cursors stay.
    void followCurves (std::size_t curves);

    /// Lays out lanes, one per unit, which share the x axis.
    void layOut (const std::vector<std::string>& units);
    Extent rangeOf (const std::string& unit, const Extent& seen);

    /// The index of the lane for a unit. Adds the lane if there is none.
    static std::size_t laneFor (std::vector<std::string>& units, const std::string& unit);

    /// An entry of a legend, such as "■ stuck".
    struct Entry
    {
        juce::Colour colour;
        juce::String text;
    };
    void paintLegend (juce::Graphics&, juce::Rectangle<float>, const std::vector<Entry>&, bool at_right = true) const;

    /// Paints lines of text at the top right of a lane.
    void paintReadout (juce::Graphics&, const juce::StringArray&, juce::Rectangle<float>) const;

    /// Shows the length of the window, and changes it by a menu.
    Action lengthAction (std::vector<double> seconds, const juce::String& about);

    const Theme& theme() const { return themeOf (*this); }

    /// The reason why there is nothing to plot of the ports.
    juce::String whyEmpty() const
    {
        return context.leaves_out ? TRANS ("Not recorded, because the scopes show too many ports. Close a scope or remove a port")
                                  : TRANS ("The graph has not run yet");
    }

    ScopeSpec& spec;
    ScopeContext& context;
    std::vector<Lane> lanes;

private:
    std::size_t laneAt (juce::Point<float>) const;
    void paintScales (juce::Graphics&, const Lane&) const;
    void paintCursors (juce::Graphics&) const;

    std::map<std::string, AutoRange> ranges;
    bool dragged = false;
    std::size_t followed = 0;   // curves
};

/// The colour of a component of the n-th port of a quantity. The first port has the quantity's colour, and components differ in lightness.
juce::Colour traceColour (const Theme&, Quantity, std::size_t nth_port, std::size_t component = 0, std::size_t components = 1);

/// Opens a menu of ports, by node.
void choosePort (juce::Component& below, const std::vector<ScopePort>&, std::function<void (const std::string&)>);

std::unique_ptr<ScopePlot> makePlot (ScopeSpec&, ScopeContext&);

}   // namespace tactus::host
