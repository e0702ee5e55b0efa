// SPDX-License-Identifier: MIT
#include "aliasing.hpp"
#include "signal_kind.hpp"
#include <tactus/plan/flat/make_node.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace tactus::plan
{

namespace
{
/// The frequencies in the params and settings of a node, as its datasheet declares them.
class Frequencies
{
public:
    Frequencies (const Flat& flat, int node)
    {
        const auto& n = flat.node (node);
        for (std::size_t p = 0; p < n.type->params.size(); ++p)
            for (const double value : flat.param (node, p))
                note (n.type->params[p].unit, n.type->params[p].id, value);
        for (std::size_t s = 0; s < n.settings.size(); ++s)
            look (n.type->settings[s], n.settings[s]);
    }

    /// The highest frequency in Hz, 0 for none. A row `rate` counts as half its value, and only if the node declares no other
    /// frequency.
    double highest() const noexcept { return named > 0.0 ? named : sampled; }

private:
    double named = 0.0, sampled = 0.0;   // highest declared frequency, and half of the highest sampling rate, in Hz

    void note (const UnitRule& unit, std::string_view id, double value)
    {
        if (unit.kind != UnitRule::Kind::fixed || unit.unit.quantity != Quantity::frequency) return;
        auto& most = id == "rate" ? sampled : named;
        most = std::max (most, id == "rate" ? 0.5 * value : std::abs (value));
    }

    void look (const SettingSheet& sheet, const SettingValue& value)
    {
        if (const auto* number = std::get_if<double> (&value))
            note (sheet.unit, sheet.id, *number);
        else if (const auto* record = std::get_if<Values> (&value))
            look (sheet, *record);
        else if (const auto* records = std::get_if<Records> (&value))
            for (const auto& each : *records)
                look (sheet, each);
    }

    void look (const SettingSheet& sheet, const Values& record)
    {
        for (std::size_t i = 0; i < record.size(); ++i)
            look (sheet.fields[i], record[i]);
    }
};

/// The content of a signal above half of a given rate.
struct Content
{
    enum class Kind
    {
        none,
        unknown,
        some
    };

    Kind kind = Kind::none;
    std::string what {};   ///< for messages, such as "'bar' (vibration.modal) contains up to 3000 Hz"
};

/// Estimates the frequency content of signals.
class ContentEstimate
{
public:
    ContentEstimate (const Flat& f, const Setup& s) : flat (f), setup (s), sources (f.nodes.size())
    {
        for (const auto& w : flat.wires)
            if (w.from) sources[at (w.to.node)].push_back (w.from->node);
    }

    /// Content of the output of a node: the worst case of all upstream nodes that generate a signal.
    Content upstream (int node, double rate_hz) const
    {
        std::set<int> seen { node };
        std::vector<int> open { node };
        Content worst;
        while (! open.empty())
        {
            const int n = open.back();
            open.pop_back();
            const auto content = of (n, rate_hz);
            if (content && content->kind > worst.kind) worst = *content;
            if (! content)
                for (const int source : sources[at (n)])
                    if (seen.insert (source).second) open.push_back (source);
        }
        return worst;
    }

    /// Content of the signal that a node generates; nullopt for a node that only passes on its inputs.
    std::optional<Content> of (int node, double rate_hz) const
    {
        const auto& n = flat.node (node);
        if (! n.runs() || ! limits (node)) return std::nullopt;
        const auto name = "'" + n.path + "' (" + std::string (n.type->info.id) + ")";

        if (const double highest = Frequencies (flat, node).highest(); highest > 0.0)
        {
            if (highest <= 0.5 * rate_hz) return Content {};
            return Content { Content::Kind::some, name + " contains up to " + numberText (highest) + " Hz" };
        }
        if (! n.type->claims && ! n.type->warning) return generic (n) ? std::nullopt : std::optional (Content { Content::Kind::unknown });

        constexpr double fast = 1.0;   // speed of a fast stroke of the hand, in m/s
        const auto made = makeNode (flat, node);
        const double k = n.type->claims ? n.type->claims (made.get()).spatial_frequency : 0.0;
        if (k * fast > 0.5 * rate_hz)
            return Content { Content::Kind::some, name + " contains spatial frequencies up to " + numberText (k) + " 1/m, too much for strokes faster than "
                                                      + numberText (std::round (500.0 * rate_hz / k) / 1000.0) + " m/s" };
        if (k > 0.0) return Content {};

        auto slower = setup, own = setup;
        slower.rate_hz = rate_hz;
        own.rate_hz *= flat.speed (n.section);
        if (n.type->warning && n.type->warning (made.get(), own).empty())
            if (const auto text = n.type->warning (made.get(), slower); ! text.empty())
                return Content { Content::Kind::some, name + " warns at that rate: " + text };
        return generic (n) ? std::nullopt : std::optional (Content { Content::Kind::unknown });
    }

private:
    const Flat& flat;
    const Setup& setup;
    std::vector<std::vector<int>> sources;   // by node: the nodes wired into it

    /// False for a filter that is not set to low-pass, because it lets high frequencies through. True for all other nodes.
    bool limits (int node) const
    {
        const auto& n = flat.node (node);
        if (! generic (n) || n.type->inputs.empty()) return true;
        for (std::size_t p = 0; p < n.type->params.size(); ++p)
            if (const auto& names = n.type->params[p].choices; ! names.empty() && names[static_cast<std::size_t> (flat.param (node, p)[0])] != "low")
                return false;
        return true;
    }

    static bool generic (const FlatNode& n)
    {
        return std::ranges::none_of (n.type->outputs, [] (const PortSheet& row) { return row.unit.kind == UnitRule::Kind::fixed; });
    }
};

std::string folded (double rate_hz) { return "; everything above " + numberText (0.5 * rate_hz) + " Hz is aliased"; }
}   // namespace

void warnOfAliasing (Flat& flat, const PortUnits& units, const Setup& setup)
{
    if (flat.sections.size() == 1 || hasErrors (flat.messages)) return;   // nodes with errors must not be created
    const ContentEstimate estimate { flat, setup };
    const auto rateOf = [&] (int section) { return setup.rate_hz * flat.speed (section); };
    const char* remedy = "insert a low-pass with a cutoff below half the slower rate, or run this part of the graph at the faster rate";
    const auto warn = [&] (Origin origin, const std::string& text) { flat.warn ("rate/aliasing", origin, text, remedy); };

    for (int n = 0; n < flat.nodeCount(); ++n)
    {
        const auto& node = flat.node (n);
        if (! node.runs() || ! flat.rests (node.section)) continue;
        const auto content = estimate.of (n, rateOf (node.section));
        if (! content || content->kind != Content::Kind::some) continue;
        // A signal that would be aliased at the rate of the graph, too, is not the fault of the section.
        if (const auto outside = estimate.of (n, setup.rate_hz); outside && outside->kind == Content::Kind::some) continue;
        warn (node.origin, content->what + ", but runs at " + numberText (rateOf (node.section)) + " Hz in '" + flat.section (node.section).path + "'"
                               + folded (rateOf (node.section)));
    }

    for (const auto& w : flat.wires)
    {
        if (! w.from || ! w.crosses || carriedBy (flat, units, w) != SignalKind::signal) continue;
        const int start = flat.node (*w.from).section, end = flat.node (w.to).section;
        const double outside = rateOf (w.section), inside = rateOf (end), before = rateOf (start);
        const double slowest = std::min (outside, inside);
        if (slowest >= before) continue;

        const auto content = estimate.upstream (w.from->node, slowest);
        const bool out_of_times = outside < before;
        if (content.kind == Content::Kind::none || (content.kind == Content::Kind::unknown && ! out_of_times)) continue;
        const auto what = content.kind == Content::Kind::some ? content.what : "whether the signal contains higher frequencies is unknown";
        warn (w.origin, "\"" + graph::toText (*w.written) + "\" goes from " + numberText (before) + " Hz to " + numberText (slowest) + " Hz, and " + what
                            + folded (slowest));
    }
}

}   // namespace tactus::plan
