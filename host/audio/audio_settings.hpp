// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/json.hpp>
#include <framework/message.hpp>
#include <framework/units.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tactus::host::audio
{

/// What a sample of 1 means: so many N or m/s2, or a plain number. What a person measures, and not what is sent.
struct FullScale
{
    double value = 1.0;                      ///< > 0
    std::optional<Dimension> dimension {};   ///< nothing: whatever is sent there is in
};

/// One channel of a card and how it is calibrated. A sample is gain value/full_scale, and a value that is heard is
/// gain full_scale sample.
struct ChannelUse
{
    int channel = 1;   ///< of the card, from 1
    FullScale full_scale {};
    double gain = 1.0;           ///< a negative one turns the polarity
    double high_pass_hz = 0.0;   ///< 0: none. Only of what is played
};

/// A port that is played on a channel: what stands there after each tick, with all samples of the tick where there are
/// several (`times`). Of a port with several components, or of several instances, their sum: name one where the direction
/// matters. (The length would sound an octave too high.)
struct Route : ChannelUse
{
    std::string port;        ///< "mix.out", "mix.level[0]", "drag.force.x"
    std::string where;       ///< for messages
    bool if_there = false;   ///< a session's, which is for all graphs: where there is no such port, or one in another unit, it is silent
};

/// Which card. Empty texts and zeros: any.
struct CardWanted
{
    std::string type;            ///< "JACK", "ALSA", …
    std::string output, input;   ///< names, or parts of them
    double rate_hz = 0.0;
    int block = 0;   ///< frames

    bool operator== (const CardWanted&) const = default;
};

struct AudioSettings
{
    static constexpr double usual_reserve_s = 0.01;

    CardWanted card;
    double reserve_s = usual_reserve_s;   ///< how late a tick or a block may be without a gap; adds to the delay
    std::vector<Route> routes;
};

/// What a role with the driver "audio" has of the card: its signal outputs and inputs, in order.
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
/// All may be left out but the port and the channel of a route. Ids as of Fields, and audio/full_scale; unknown keys are warnings.
AudioSettings readAudioSettings (const Json&, const std::string& where, Messages&);

/// True of a description with the driver "audio".
bool isAudio (const Json& description);

/// {"driver": "audio", "outputs": [{"channel": 3, "full_scale": "4 N"}], "inputs": [{"channel": 1, "full_scale": "20 m/s2"}], "guard": {…}}
///
/// "card" names one, as --audio does (for a run without a session). Ids as of Fields, and audio/full_scale.
AudioRole readAudioRole (const Json& description, Messages&);

/// PORT=CHANNEL[@FULLSCALE], as in mix.out=3@"4 N". Id: audio/route.
std::variant<Route, Message> parseRoute (std::string_view);

/// TYPE:NAME, NAME or TYPE, where TYPE is one of these.
CardWanted parseCard (std::string_view, const std::vector<std::string>& types);

/// What is wrong with sending what is in this unit ("N", "" for unknown) to a channel so calibrated; "" if nothing.
std::string unitProblem (const FullScale&, std::string_view unit);

}   // namespace tactus::host::audio
