// SPDX-License-Identifier: MIT
#pragma once

#include "session_file.hpp"

#include <tactus/text/json.hpp>
#include <tactus/text/result.hpp>
#include <tactus/text/units.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host::audio
{

/// The physical value of a sample of 1, in N or m/s2, or a plain number. You measure it at the actuator; it is not sent to
/// the card.
struct FullScale
{
    double value = 1.0;                      ///< > 0
    std::optional<Dimension> dimension {};   ///< empty: any unit
};

/// One channel of a card and its calibration. Output: sample = gain value/full_scale. Input: value = gain full_scale
/// sample.
struct ChannelUse
{
    int channel = 1;   ///< channel of the card, counted from 1
    FullScale full_scale {};
    double gain = 1.0;           ///< negative: inverted polarity
    double high_pass_hz = 0.0;   ///< cutoff of a high-pass filter; 0: no filter. For outputs only
};

/// A port that is played on a channel: its value after each tick, or all samples of the tick if it has several (`times`).
/// The components or instances of a port are summed: name one component if the direction matters. (The length of a vector
/// would sound an octave too high.)
struct Route : ChannelUse
{
    std::string port;        ///< "mix.out", "mix.level[0]", "drag.force.x"
    std::string where;       ///< where the route was given, for messages
    bool if_there = false;   ///< true for a route of a session, which serves all graphs: silent if the port is missing or has a different unit
};

/// Selects a card. Empty strings and zeros match any card.
struct CardRequest
{
    std::string type;            ///< "JACK", "ALSA", …
    std::string output, input;   ///< names of cards, or parts of the names
    double rate_hz = 0.0;
    int block = 0;   ///< frames per block

    bool operator== (const CardRequest&) const = default;
};

struct AudioSettings
{
    static constexpr double usual_reserve_s = 0.01;

    CardRequest card;
    double reserve_s = usual_reserve_s;   ///< how late a tick or a block may be without causing a gap; adds to the latency
    std::vector<Route> routes;
};

/// The signal outputs and inputs of a role with the driver "audio", in order.
struct AudioRole
{
    std::vector<ChannelUse> outputs, inputs;
};

inline constexpr int most_channels = 64;

/// The key "audio" of a session:
///
///     {"type": "JACK", "output": "system", "input": "system", "rate_hz": 48000, "block": 64, "reserve": "10 ms",
///      "routes": [{"port": "mix.out", "channel": 1, "full_scale": "4 N", "gain": 1, "high_pass": "20 Hz"}]}
///
/// Everything but the port and channel of a route is optional. Ids: those of ObjectReader, and audio/full_scale. Unknown keys are
/// warnings.
AudioSettings readAudioSettings (const Json&, const std::string& where, Messages&);

/// The sound settings of a session; the default ones if it has none. Messages name the file of the session.
AudioSettings readAudioSettings (const LoadedSession&, Messages&);

/// True for a description with the driver "audio".
bool isAudio (const Json& description);

/// Reads {"driver": "audio", "outputs": [{"channel": 3, "full_scale": "4 N"}], "inputs": [{"channel": 1, "full_scale": "20 m/s2"}], "guard": {…}}
///
/// "card" selects a card as --audio does (for a run without a session). Ids: those of ObjectReader, and audio/full_scale.
AudioRole readAudioRole (const Json& description, Messages&);

/// Parses PORT=CHANNEL[@FULLSCALE], as in mix.out=3@"4 N". Id: audio/route.
Result<Route> parseRoute (std::string_view);

/// Parses TYPE:NAME, NAME or TYPE. `types` are the known types.
CardRequest parseCard (std::string_view, const std::vector<std::string>& types);

/// The reason why a port with this unit ("N"; "" if unknown) cannot be played on a channel with this calibration; "" if it can.
std::string unitProblem (const FullScale&, std::string_view unit);

}   // namespace tactus::host::audio
