// SPDX-License-Identifier: GPL-3.0-or-later
#include "energy_plot.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

juce::TextLayout EnergyPlot::layout() const
{
    const auto ink = meter.balance().isPassive() ? theme().text : theme().warning;
    return wrapText (text, lookOf (*this).font (12.0f), ink, static_cast<float> (getWidth()) - 2.0f * margin);
}

void EnergyPlot::show (const Signals& signals)
{
    repaint();
    if (! spec.is_frozen)
    {
        EnergyMeter::Sources sources { signals (spec.x), signals (spec.y), {}, {}, context.hand_delay };
        for (const auto& port : context.energies)
            for (const auto& t : signals (port))
                (port.ends_with ("stored_energy") ? sources.stored : sources.dissipated).push_back (t);
        meter.follow (sources);
    }
    const auto& traces = meter.traces();
    if (traces.empty() || endOf (traces) == 0)
    {
        lanes.clear();
        return;
    }
    is_reset = false;
    layOut ({ "J" });
    auto& lane = lanes.front();
    constexpr float least_plot = 40.0f;   // pixels; the numbers and the legend give way to it
    text = context.energies_left_out > 0 ? filled (TRANS ("work of the hand %1; the energy of the nodes is not recorded, because %2 ports report one"),
                                                   withPrefix (meter.balance().work, "J", 2), context.energies_left_out)
                                         : juce::String::fromUTF8 (describe (meter.balance()).c_str());
    if (lane.area.getHeight() - layout().getHeight() < least_plot) text = text.upToFirstOccurrenceOf (":", false, false);
    lane.area.removeFromTop (layout().getHeight());
    has_legend = lane.area.getHeight() - legend_height >= least_plot;
    if (has_legend) lane.area.removeFromTop (legend_height);
    rate_hz = traces.front()->rate();
    const auto seen = windowOf (traces, spec.seconds, {}, 0.0);
    zero = seen.to;
    const auto columns = static_cast<std::size_t> (std::max (1.0f, lane.area.getWidth()));
    const auto& of_work = work.update (traces[0], seen.from, seen.to, columns).all;
    const auto& of_stored = stored.update (traces[1], seen.from, seen.to, columns).all;
    const auto& of_heat = dissipated.update (traces[2], seen.from, seen.to, columns).all;
    Extent extent { 0.0, 0.0 };
    for (std::size_t i = 0; i < of_work.size(); ++i)
    {
        if (of_work[i].extent.isEmpty()) continue;
        extent.include (of_work[i].extent);
        extent.include (of_heat[i].extent.low);
        extent.include (of_heat[i].extent.high + of_stored[i].extent.high);
    }
    lane.x = { -spec.seconds, 0.0 };
    lane.x_unit = "s";
    lane.y = rangeOf ("J", extent);
}

void EnergyPlot::paintLane (juce::Graphics& g, const Lane& lane, std::size_t)
{
    Points floor, heat, top;
    const auto flush = [&] {
        drawBetween (g, lane, floor, heat, theme().of (Quantity::energy).withAlpha (0.35f));
        drawBetween (g, lane, heat, top, theme().of (Quantity::length).withAlpha (0.55f));
        floor.clear();
        heat.clear();
        top.clear();
    };
    const auto& columns = work.columns();
    for (std::size_t i = 0; i < columns.all.size(); ++i)
    {
        const auto &d = dissipated.columns().all[i].extent, &s = stored.columns().all[i].extent;
        if (d.isEmpty() || s.isEmpty())
        {
            flush();
            continue;
        }
        const double x = (columns.first + static_cast<double> (i) * columns.ticks_each - zero) / rate_hz;
        floor.push_back ({ x, 0.0 });
        heat.push_back ({ x, d.high });
        top.push_back ({ x, d.high + s.high });
    }
    flush();
    drawTrace (g, lane, columns, zero, rate_hz, theme().text);
}

void EnergyPlot::paintOver (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& lane = lanes.front();
    const auto& now = meter.balance();
    layout().draw (g, getLocalBounds().toFloat().reduced (margin, 4.0f));
    const auto legend = lane.area.withY (lane.area.getY() - legend_height).withHeight (legend_height);
    const auto stored_ink = theme().of (Quantity::length).withAlpha (0.55f), lost_ink = theme().of (Quantity::energy).withAlpha (0.45f);
    if (has_legend)
        paintLegend (g, legend, { { theme().text, TRANS ("hand") }, { stored_ink, TRANS ("stored") }, { lost_ink, TRANS ("dissipated") } });
    if (now.gaps == 0) return;
    g.setFont (look.font (11.0f));
    g.setColour (theme().dim);
    const auto line = lane.area.reduced (8.0f, 4.0f).removeFromBottom (14.0f);
    g.drawText (filled (now.gaps == 1 ? TRANS ("%1 missed tick") : TRANS ("%1 missed ticks"), now.gaps), line, juce::Justification::bottomLeft, true);
}

std::vector<ScopePlot::Action> EnergyPlot::actions()
{
    return { { TRANS ("reset"), TRANS ("Restarts the energy balance from zero"), [this] (juce::Component&) {
                  meter.restart();
                  is_reset = true;
                  if (context.onChange) context.onChange();
              } } };
}

juce::String EnergyPlot::emptyText() const
{
    if (spec.x.empty() || spec.y.empty()) return TRANS ("Energy needs a device.position node for the hand, and a device.force node for the force on it");
    return is_reset ? TRANS ("The balance begins with the next tick") : whyEmpty();
}

}   // namespace tactus::host
