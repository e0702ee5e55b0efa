// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/tools/figures/axis.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

enum class ScopeKind
{
    time,   ///< an oscilloscope
    over,   ///< one signal against another, such as force against displacement
    spectrum,
    spectrogram,   ///< the frequencies of one signal over time
    energy,
    tool   ///< a friction node seen from above
};

struct ScopeTrigger
{
    enum class Edge
    {
        off,
        rising,
        falling
    };

    Edge edge = Edge::off;
    double level = 0.0;   ///< a value of the first trace, in SI units
    bool operator== (const ScopeTrigger&) const = default;
};

/// A clicked position: x in s, Hz or the unit of the x axis, y in the unit of its lane, on a curve if there is one at x.
struct Cursor
{
    std::size_t lane = 0;
    double x = 0.0, y = 0.0;
    std::optional<std::size_t> curve {};   ///< the number of the curve that it reads, while the curve moves, too; empty: none
    bool operator== (const Cursor&) const = default;
};

/// The ports that one scope shows, and how it shows them. Ports have the same names as in `tactus render --record`.
struct ScopeSpec
{
    static constexpr double least_s = 5e-3, most_s = 10.0;

    ScopeKind kind = ScopeKind::time;
    std::vector<std::string> ports;   ///< time, spectrum: the traces; spectrogram: its one trace
    std::string x, y, state;          ///< over: the axes, and the state (stuck or sliding); energy: hand position, and force on the hand
    std::string node;                 ///< tool: the friction node
    bool has_normal = false;          ///< tool: true if the node's input `normal` is wired
    int component = -1;               ///< over: component of vectors; -1 for the one that moves most
    double seconds = 1.0;             ///< length of the window
    double back_s = 0.0;              ///< time: how long before the newest tick the window ends, while frozen
    ScopeTrigger trigger;
    double up_to_hz = 1000.0;               ///< spectrogram: the highest frequency; 0: half the rate
    bool in_decibels = true;                ///< spectrum: true if amplitudes are in decibels
    std::map<std::string, Extent> zoomed;   ///< ranges that the user has zoomed, by unit
    std::vector<Cursor> cursors;            ///< at most two
    bool is_frozen = false;
    double share = 1.0;   ///< of the width of its row, relative to the other scopes in it
    bool operator== (const ScopeSpec&) const = default;

    /// Adds a trace. A spectrogram replaces its trace, because it shows only one.
    void addPort (const std::string& port)
    {
        if (kind == ScopeKind::spectrogram) ports.clear();
        ports.push_back (port);
    }
};

/// The scopes of a window, from left to right.
struct ScopeModel
{
    std::vector<std::unique_ptr<ScopeSpec>> scopes;
    const ScopeSpec* active = nullptr;   ///< gets new probes, if it can show them

    /// Adds a port to the active scope, or to the first oscilloscope, or to a new one. Removes the port if it is there already. Returns
    /// true if it is shown now.
    bool probe (const std::string& port);

    /// True if a scope shows the port as a trace.
    bool shows (const std::string& port) const;
};

/// True if a scope shows ports as traces.
bool holdsProbes (const ScopeSpec&);

/// All ports that a scope reads, including those it only computes with.
std::vector<std::string> portsOf (const ScopeSpec&, const std::vector<std::string>& energies);

/// Handles a click: the first two set cursors, the third removes both.
void click (std::vector<Cursor>&, const Cursor&);

/// An automatic axis range. It widens immediately, and narrows only after the narrower range would have been enough for a while, so
/// that it does not change with every stroke.
class AutoRange
{
public:
    static constexpr int usual_patience = 45;   ///< updates

    explicit AutoRange (int patience = usual_patience) : updates_to_wait (patience) {}

    const Extent& update (const Extent& seen);
    const Extent& shown() const noexcept { return range; }

private:
    static constexpr double air = 0.08, much_less = 0.6;

    int updates_to_wait, calm = 0;
    bool is_guess = true;   // true until the signal has moved
    Extent range, since_calm;
};

}   // namespace tactus::host
