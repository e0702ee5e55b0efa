// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/result.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// The motors of a vest, and the messages for the program that drives it (bHaptics Player, version 2). Signals and a force become intensities from 0 to
/// 100: a channel drives the motors that its map names, or those around a place; a force drives those on the side that it comes from. Between two messages,
/// the largest value counts, because the motors have no phase. The same values give the same messages. [one thread]
class Dots
{
public:
    static constexpr int duration_ms = 100;   ///< how long a message lasts, if no other one comes

    /// `map` is vest.json. The person's `description` can have "channels" of its own, each {"dots": {"VestFront": [0, 1]}} or {"at": [x, y, z], "radius": r}
    /// in m, and "full_force" in N. Id: dots/wrong.
    static Result<Dots> read (const Json& map, const Json& description);

    std::size_t channels() const noexcept { return weights.size(); }

    /// Takes the values of a tick: signals, where 1 is the full intensity, and a force on the body in N.
    void take (std::span<const double> signals, const Vec3& force) noexcept;

    /// Forgets what was taken since the last message.
    void forget() noexcept;

    /// From now on, no motor gets more than this part of its full intensity, whatever drives it.
    void limit (double part) noexcept;

    /// The force that drives a motor with its full intensity, in N.
    double fullForce() const noexcept { return full_force; }

    /// The message for what was taken since the last one. Empty if that is nothing and nothing shows.
    std::string message();

    /// The message that ends everything. What was taken before is forgotten.
    std::string silence();

    /// True if the last message drives a motor.
    bool isShowing() const noexcept;

private:
    struct Dot
    {
        std::size_t place = 0;
        int index = 0;   // within the place
        Vec3 at = Vec3::Zero(), out = Vec3::Zero();
    };

    /// A part of the body that a message names.
    struct Place
    {
        std::string name;
        bool shows = false;
    };

    std::string readPlaces (const Json& map);
    std::string readChannel (const Json& channel);

    std::vector<Place> places;
    std::vector<Dot> dots;
    std::vector<std::vector<double>> weights;   // of each channel, for each dot
    double full_force = 10.0;                   // N
    int most = 100;                             // intensity

    std::vector<double> peaks;    // of each channel since the last message
    std::vector<double> pushed;   // each dot by the force, since the last message
};

}   // namespace tactus::host
