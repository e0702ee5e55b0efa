// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/io/axis.hpp>

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
    over,   ///< one thing over another, as force over displacement
    spectrum,
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
    double level = 0.0;   ///< SI, of the first trace
};

/// A place that was clicked: in s, Hz or what the abscissa is of, and in the unit of its lane.
struct Cursor
{
    std::size_t lane = 0;
    double x = 0.0, y = 0.0;
};

/// What one scope shows, and how. Ports are named as `tactus render --record` names them.
struct ScopeSpec
{
    static constexpr double least_s = 5e-3, most_s = 10.0;

    ScopeKind kind = ScopeKind::time;
    std::vector<std::string> ports;   ///< time, spectrum: what is shown
    std::string x, y, state;          ///< over: the axes, and what tells sticking from sliding; energy: where the hand is, and the force on it
    std::string node;                 ///< tool: of friction
    bool has_normal = false;          ///< tool: something is wired to its normal
    int component = -1;               ///< over: of vectors; -1 for the one that moves most
    double seconds = 1.0;             ///< how far back is shown
    double back_s = 0.0;              ///< time: how far before the newest the window ends, while frozen
    ScopeTrigger trigger;
    bool in_decibels = true;                 ///< spectrum
    std::map<std::string, Extent> by_hand;   ///< ranges that were zoomed by hand, by unit
    std::vector<Cursor> cursors;             ///< two at most
    bool is_frozen = false;
};

/// The scopes of a window, from left to right.
struct ScopeModel
{
    std::vector<std::unique_ptr<ScopeSpec>> scopes;
    const ScopeSpec* active = nullptr;   ///< what a probe goes to, if it can hold one

    /// Adds a port to the active scope, or to the first that shows any port over time; takes it out if it is there. A new
    /// scope is made if there is none. True if it is shown now.
    bool probe (const std::string& port);

    /// True if a scope shows it as a trace of its own.
    bool shows (const std::string& port) const;
};

/// The ports that a scope needs, some for what it works out from them.
std::vector<std::string> portsOf (const ScopeSpec&, const std::vector<std::string>& energies);

/// A click: the first place, the second, and the third takes both away.
void click (std::vector<Cursor>&, const Cursor&);

/// The range of an axis that follows what is seen: it widens at once, and narrows once that would have been enough for a
/// while, so that it does not breathe with every stroke.
class AutoRange
{
public:
    explicit AutoRange (int patience = 45) : updates_to_wait (patience) {}

    const Extent& update (const Extent& seen);
    const Extent& shown() const noexcept { return range; }

private:
    static constexpr double air = 0.08, much_less = 0.6;

    int updates_to_wait, calm = 0;
    bool is_guess = true;   // nothing has moved yet
    Extent range, since_calm;
};

}   // namespace tactus::host
