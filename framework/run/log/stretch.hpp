// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/replay.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace tactus
{

/// A stretch of a logged run: the values of ports, and the movement of a hand.
struct Stretch
{
    double rate_hz = 0.0;
    std::uint64_t from = 0, until = 0;     ///< ticks; `until` is the one after the last
    std::vector<std::string> names {};     ///< of the components, such as "motor.force.x"
    Quantity quantity = Quantity::any;     ///< of the first component
    std::string unit {};                   ///< SI symbol of the first component; "" if unknown
    std::vector<double> values {};         ///< tick by tick, with all components of each
    std::vector<std::string> columns {};   ///< of the movement, as readTrace reads them; empty if no role was asked for
    std::vector<double> movement {};       ///< tick by tick, with all columns of each; times begin at 0

    std::size_t ticks() const noexcept { return static_cast<std::size_t> (until - from); }
    double value (std::size_t tick, std::size_t component) const noexcept { return values[tick * names.size() + component]; }
};

/// Replays a logged run, and keeps the values of a stretch. The ticks before the stretch are replayed, too, because the state of the nodes
/// is known only at the start of the run. It works in slices, so that a window stays responsive. [main thread]
class StretchReader
{
public:
    struct Options
    {
        double from_s = 0.0, until_s = std::numeric_limits<double>::infinity();
        std::vector<std::string> records {};   ///< ports; empty: the inputs of all sinks
        std::string role {};                   ///< the role whose movement to keep; empty: none
        Assets* assets = nullptr;
        Services services {};
        std::string program {};   ///< as in Replay::Options
    };

    /// Ids: those of Replay, take/role, take/empty.
    static Result<std::unique_ptr<StretchReader>> open (const std::string& log, const Options&);

    /// Plays at most this many ticks. Returns false at the end of the stretch or of the run. Ids: those of Replay, take/too_large.
    Result<bool> advance (std::uint64_t ticks);

    std::uint64_t tick() const noexcept { return now; }                      ///< the next tick to play
    double rate() const noexcept { return replay->rate(); }                  ///< Hz
    const graph::Graph& graph() const noexcept { return replay->graph(); }   ///< what is played now
    const std::string& name() const noexcept { return replay->name(); }      ///< of the graph
    const std::vector<Tap>& taps() const { return replay->run().engine().plan().taps(); }
    std::string firstRole() const;   ///< of the graph; empty if it has none
    Messages takeWarnings() { return replay->takeWarnings(); }

    /// The stretch, once advance() has returned false. Ids: take/empty.
    Result<Stretch> take();

private:
    StretchReader (std::unique_ptr<Replay>, const Options&, std::string log);

    Result<> begin (const Options&);
    const DeviceState* hand() const;
    void keep();
    void keepMovement();

    std::unique_ptr<Replay> replay;
    std::string log, role;
    Stretch kept;
    std::uint64_t now = 0;
};

/// Reads a whole stretch at once.
Result<Stretch> readStretch (const std::string& log, StretchReader::Options, Messages& warnings);

}   // namespace tactus
