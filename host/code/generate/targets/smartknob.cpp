// SPDX-License-Identifier: MIT
#include "smartknob.hpp"

#include <host/devices/hid/report/crc32.hpp>
#include <host/devices/hid/report/framing.hpp>
#include <tactus/run/engine.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

namespace tactus::host
{
namespace
{
constexpr double turn = 2.0 * std::numbers::pi;
constexpr int steps_per_turn = 3600;
constexpr double step = turn / steps_per_turn;          // rad
constexpr double narrowest = 20.0 * step;               // a detent, so that its shape is seen
constexpr double guessed_torque_per_volt = 5e-3;        // N m
constexpr double usual_width = turn / 6.0;              // of a knob with one detent, where it means nothing
constexpr double uneven = 0.05;                         // of a width
constexpr double still = 1e-9, settles_within = 0.25;   // of the torque, between ticks; s
constexpr std::size_t longest_text = 49;

Message refusal (const char* id, std::string text, std::string remedy) { return Message::error (id, "", std::move (text), std::move (remedy)); }

std::string inRadians (double angle) { return roundedText (angle, 3) + " rad"; }
std::string percent (double share) { return roundedText (100.0 * share, 2) + " %"; }

/// A knob that is turned by this program.
struct TurnedKnob final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override
    {
        Reading reading;
        reading.rotation.z() = angle;
        return reading;
    }
    void write (const Effort& effort) noexcept override { torque = effort.torque.z(); }

    double angle = 0.0, torque = 0.0;   // rad, N m
};

/// The angles that a knob is turned through: to one side, all the way to the other one, and back.
struct Way
{
    std::vector<double> angles;
    std::size_t up = 0, down = 0;   // where the way up begins, and the way down
};

Way wayOfKnob()
{
    Way way;
    constexpr int half = steps_per_turn / 2;
    for (int i = 0; i > -half; --i)
        way.angles.push_back (i * step);
    way.up = way.angles.size();
    for (int i = -half; i < half; ++i)
        way.angles.push_back (i * step);
    way.down = way.angles.size();
    for (int i = half; i >= -half; --i)
        way.angles.push_back (i * step);
    return way;
}

/// The torque at each angle of the way, once it has settled.
Result<std::vector<double>> torquesAlong (const Way& way, const std::shared_ptr<Plan>& plan)
{
    TurnedKnob knob;
    Engine engine { plan };
    engine.attach (plan->roles().front().name, knob);
    constexpr int calm_for = 8;   // ticks; longer than most delays in a graph
    const int most = std::max (2 * calm_for, static_cast<int> (settles_within * plan->rateHz()));
    std::vector<double> torques;
    for (const double angle : way.angles)
    {
        knob.angle = angle;
        int calm = 0;
        for (int ticks = 0; ticks < most && calm < calm_for; ++ticks)
        {
            const double before = knob.torque;
            engine.tick();
            calm = std::abs (knob.torque - before) <= still * (1.0 + std::abs (before)) ? calm + 1 : 0;
        }
        if (calm < calm_for)
            return refusal ("smartknob/moves",
                            "the torque changes while the knob rests at " + inRadians (angle) + ", but a SmartKnob accepts only detents",
                            "leave out what vibrates or moves by itself");
        torques.push_back (knob.torque);
    }
    return torques;
}

/// The angles where the torque changes its sign as the angle increases: at detents from + to -, between them from - to +.
struct Sides
{
    std::vector<double> detents, between;
};

Sides sidesOf (std::span<const double> torques, double first_angle, double nothing)
{
    Sides sides;
    std::optional<std::size_t> last;   // that was not 0
    for (std::size_t i = 0; i < torques.size(); ++i)
    {
        if (std::abs (torques[i]) <= nothing) continue;
        if (last && (torques[i] > 0.0) != (torques[*last] > 0.0))
        {
            const double share = i == *last + 1 && torques[i] < 0.0 ? torques[*last] / (torques[*last] - torques[i]) : 0.5;
            const double at = first_angle + step * (static_cast<double> (*last) + share * static_cast<double> (i - *last));
            (torques[i] < 0.0 ? sides.detents : sides.between).push_back (at);
        }
        last = i;
    }
    return sides;
}

double nearest (const std::vector<double>& all, double to)
{
    return *std::ranges::min_element (all, {}, [to] (double a) { return std::abs (a - to); });
}

/// The mean distance from a detent to where the torque changes its side, in the direction of travel (1: counterclockwise). Empty if there is none.
std::optional<double> reach (const Sides& sides, double direction)
{
    double sum = 0.0;
    int count = 0;
    for (const double edge : sides.between)
    {
        std::optional<double> least;
        for (const double detent : sides.detents)
            if (const double d = direction * (edge - detent); d > 0.0 && (! least || d < *least)) least = d;
        if (! least) continue;
        sum += *least;
        ++count;
    }
    return count > 0 ? std::optional (sum / count) : std::nullopt;
}

/// The places of the detents, from which the configuration follows, but for the strengths.
Result<KnobConfig> placesOf (const Sides& up, const Sides& down)
{
    if (up.detents.empty() || down.detents.empty())
        return refusal ("smartknob/no_detent", "the torque about z pulls the knob back to no angle within a turn, so there is no detent",
                        "wire the rotation of device.position to a torque that changes its sign from angle to angle, and this to the torque of device.force");
    KnobConfig config;
    config.width = usual_width;
    const auto& detents = up.detents;
    const double home = nearest (detents, 0.0);
    if (detents.size() > 1)
    {
        config.width = (detents.back() - detents.front()) / static_cast<double> (detents.size() - 1);
        for (std::size_t i = 1; i < detents.size(); ++i)
            if (std::abs (detents[i] - detents[i - 1] - config.width) > uneven * config.width)
                return refusal ("smartknob/uneven",
                                "the detents at " + inRadians (detents[i - 1]) + " and " + inRadians (detents[i]) + " are not as far apart as the others, "
                                    + inRadians (config.width) + " on average, but a SmartKnob has one width",
                                "space them evenly");
        if (config.width < narrowest)
            return refusal ("smartknob/fine",
                            "the detents are " + inRadians (config.width) + " apart; at least " + inRadians (narrowest) + " can be exported",
                            "use fewer detents per turn");
        if (const auto forth = reach (up, 1.0), back = reach (down, -1.0); forth && back)
        {
            const double snap = 0.5 * (*forth + *back) / config.width;
            if (snap > 0.5 + step / config.width) config.snap_point = snap;   // else it is in the middle, as exactly as it was seen
        }
    }
    // Without ends, the detents go on beyond the turn that was looked at.
    const double room = (config.snap_point + uneven) * config.width + step, half = 0.5 * turn;
    const bool has_ends = detents.size() == 1 || (detents.front() + half > room + 0.5 * config.width && half - detents.back() > room + 0.5 * config.width);
    if (has_ends)
    {
        config.min_position = -static_cast<std::int32_t> (std::ranges::count_if (detents, [&] (double d) { return d > home; }));
        config.max_position = static_cast<std::int32_t> (std::ranges::count_if (detents, [&] (double d) { return d < home; }));
    }
    config.sub_position = home / config.width;
    return config;
}

/// The pull of the knob at an angle, and the torque of the graph there.
struct Compared
{
    KnobLaw::Pull pull;
    double torque = 0.0;   // of the graph, in N m
};

/// Leaves out the places where the torque jumps from detent to detent, which are known to a step only, and what is beyond a stop by more than a
/// width, where a hand does not turn the knob.
std::vector<Compared> compare (const KnobConfig& config, const Way& way, const std::vector<double>& torques)
{
    KnobLaw law (config);
    std::vector<KnobLaw::Pull> pulls;
    for (const double angle : way.angles)
        pulls.push_back (law (angle));
    const auto jumps = [&] (std::size_t i) { return std::abs (pulls[i].angle - pulls[i - 1].angle) > 0.5 * config.width; };
    constexpr std::size_t around = 3;
    std::vector<Compared> all;
    for (std::size_t i = way.up; i + around < pulls.size(); ++i)
    {
        bool is_edge = false;
        for (std::size_t k = i - around + 1; k <= i + around; ++k)
            is_edge = is_edge || jumps (k);
        if (! is_edge && (! pulls[i].at_end || std::abs (pulls[i].angle) <= config.width)) all.push_back ({ pulls[i], torques[i] });
    }
    return all;
}

/// The strength by least squares, of the detents or of the stops.
double strengthOf (const std::vector<Compared>& all, bool at_end, double torque_per_volt)
{
    double product = 0.0, square = 0.0;
    for (const auto& [pull, torque] : all)
        if (pull.at_end == at_end)
        {
            const double unit = KnobLaw::volts_per_rad * torque_per_volt * pull.angle;
            product += unit * torque;
            square += unit * unit;
        }
    return square > 0.0 ? std::max (0.0, product / square) : 0.0;
}

//==============================================================================
// Protocol buffers, by their wire format.

std::string varint (std::uint64_t v)
{
    std::string bytes;
    for (; v >= 0x80; v >>= 7)
        bytes += static_cast<char> ((v & 0x7f) | 0x80);
    return bytes + static_cast<char> (v);
}

std::string numberField (int field, std::int64_t v)
{
    return v == 0 ? std::string() : varint (static_cast<std::uint64_t> (field << 3)) + varint (static_cast<std::uint64_t> (v));
}

std::string floatField (int field, double v)
{
    const auto raw = std::bit_cast<std::uint32_t> (static_cast<float> (v));
    if (raw == 0) return {};
    auto bytes = varint (static_cast<std::uint64_t> (field << 3 | 5));
    for (int i = 0; i < 4; ++i)
        bytes += static_cast<char> ((raw >> 8 * i) & 0xff);
    return bytes;
}

std::string bytesField (int field, const std::string& content)
{
    return varint (static_cast<std::uint64_t> (field << 3 | 2)) + varint (content.size()) + content;
}

/// The zone in the middle of a detent in which the knob does not pull, to each side.
double deadZone (const KnobConfig& config) { return std::min (0.2 * config.width, turn / 360.0); }

/// The largest torque that a knob with this configuration gives, in N m. Beyond a stop it rises to the most volts.
double strongestOf (const KnobConfig& config, double torque_per_volt)
{
    const double volts = KnobLaw::volts_per_rad * config.detent_strength * (config.snap_point * config.width - deadZone (config));
    const bool has_stops = config.hasEnds() && config.endstop_strength > 0.0;
    return torque_per_volt * (has_stops ? KnobLaw::most_volts : std::min (volts, KnobLaw::most_volts));
}

std::uint32_t crcOf (const std::string& text) { return hid::crc32 ({ reinterpret_cast<const std::uint8_t*> (text.data()), text.size() }); }

/// Not all of it can be chosen by a graph: the colour, and a lean of the snap point, stay 0.
std::string encoded (const KnobConfig& c)
{
    auto bytes = floatField (2, c.sub_position);
    bytes += numberField (4, c.min_position) + numberField (5, c.max_position) + floatField (6, c.width) + floatField (7, c.detent_strength);
    bytes += floatField (8, c.endstop_strength) + floatField (9, c.snap_point) + bytesField (10, c.text);
    return bytes;
}

}   // namespace

KnobLaw::KnobLaw (const KnobConfig& c) noexcept : config (c), centre (c.sub_position * c.width) {}

KnobLaw::Pull KnobLaw::operator() (double angle) noexcept
{
    double off = angle - centre;
    const double snap = config.width * config.snap_point;
    if (off > snap && (! config.hasEnds() || position > config.min_position))
    {
        centre += config.width;
        off -= config.width;
        --position;
    }
    else if (off < -snap && (! config.hasEnds() || position < config.max_position))
    {
        centre -= config.width;
        off += config.width;
        ++position;
    }
    const double dead = deadZone (config);
    const bool at_end = config.hasEnds() && ((off > 0.0 && position == config.min_position) || (off < 0.0 && position == config.max_position));
    return { .angle = std::clamp (off, -dead, dead) - off, .at_end = at_end };
}

Result<KnobFit> fitKnob (const std::shared_ptr<Plan>& plan, const KnobOptions& options, double max_torque)
{
    if (plan->roles().size() != 1)
        return refusal ("smartknob/role", "a SmartKnob has one axis, but the graph has " + std::to_string (plan->roles().size()) + " roles",
                        "export a graph with one role, the knob");
    const auto way = wayOfKnob();
    auto along = torquesAlong (way, plan);
    if (! along) return std::move (along).error();
    const auto& torques = *along;

    KnobFit fit;
    fit.torque_per_volt = options.torque_per_volt > 0.0 ? options.torque_per_volt : guessed_torque_per_volt;
    double nothing = 0.0;
    for (const double t : torques)
        nothing = std::max (nothing, 1e-3 * std::abs (t));
    std::vector<double> down (torques.begin() + static_cast<std::ptrdiff_t> (way.down), torques.end());
    std::ranges::reverse (down);
    const auto up = std::span (torques).subspan (way.up, way.down - way.up);
    auto places = placesOf (sidesOf (up, way.angles[way.up], nothing), sidesOf (down, way.angles.back(), nothing));
    if (! places) return std::move (places).error();
    fit.config = *places;

    const auto compared = compare (fit.config, way, torques);
    fit.config.detent_strength = strengthOf (compared, false, fit.torque_per_volt);
    fit.config.endstop_strength = fit.config.hasEnds() ? strengthOf (compared, true, fit.torque_per_volt) : 1.0;

    double off = 0.0, all = 0.0, most_volts = 0.0;
    fit.largest = 0.0;
    for (const auto& [pull, torque] : compared)
    {
        const double volts = KnobLaw::volts_per_rad * pull.angle * (pull.at_end ? fit.config.endstop_strength : fit.config.detent_strength);
        const double differs = torque - std::clamp (volts, -KnobLaw::most_volts, KnobLaw::most_volts) * fit.torque_per_volt;
        off += differs * differs;
        all += torque * torque;
        fit.largest = std::max (fit.largest, std::abs (torque));
        if (! pull.at_end) most_volts = std::max (most_volts, std::abs (volts));
    }
    fit.rms = std::sqrt (off / static_cast<double> (compared.size()));
    if (most_volts > KnobLaw::most_volts)
        return refusal ("smartknob/strong",
                        "the detents need " + roundedText (most_volts, 3) + " V at a motor of " + roundedText (fit.torque_per_volt, 3)
                            + " N*m per volt; the knob gives at most " + roundedText (KnobLaw::most_volts, 3) + " V",
                        "make the detents weaker, or say how strong the motor is: --torque-per-volt \"5 mN*m\"");
    if (const double strongest = strongestOf (fit.config, fit.torque_per_volt); strongest > max_torque)
        return refusal ("smartknob/limit",
                        "the knob could give " + roundedText (strongest, 3) + " N*m" + (fit.config.hasEnds() ? " at its stops" : "")
                            + ", but no guard comes after it, and the role " + quote (plan->roles().front().name) + " is limited to "
                            + roundedText (max_torque, 3) + " N*m",
                        fit.config.hasEnds() ? "allow the role more, or leave out the stops" : "make the detents weaker, or allow the role more");
    if (off > 0.5 * all)
        return refusal ("smartknob/shape",
                        "the torque differs from the closest that a SmartKnob can do by " + percent (std::sqrt (off / all))
                            + " of its root mean square, so it would not be felt as this graph",
                        "leave out friction and textures, and keep detents that pull towards their middle");
    return fit;
}

std::string knobMessage (const KnobConfig& config)
{
    constexpr int protocol_version = 1;
    const auto content = encoded (config);
    const auto message = numberField (1, protocol_version) + numberField (2, crcOf (content) | 1u) + bytesField (4, content);
    const std::span report (reinterpret_cast<const std::uint8_t*> (message.data()), message.size());
    hid::Bytes frame (hid::longestFrame (hid::Framing::cobs, report.size()));
    frame.resize (hid::writeFrame (hid::Framing::cobs, report, frame));
    return { frame.begin(), frame.end() };
}

std::vector<std::pair<std::string, std::string>> knobFiles (const std::string& stem, const KnobFit& fit, const KnobOptions& options, Messages& messages)
{
    const auto inMillinewtons = [] (double torque) { return roundedText (1e3 * torque, 3) + " mN*m"; };
    const bool is_guess = options.torque_per_volt <= 0.0;
    if (const double differs = fit.largest > 0.0 ? fit.rms / fit.largest : 0.0; differs > 0.05)
        messages.push_back (Message::warning ("smartknob/shape", "",
                                              "the torques of the knob differ from those of the graph by " + percent (differs)
                                                  + " of the largest (root mean square)",
                                              "a SmartKnob pulls like a spring from detent to detent, with a dead zone in the middle"));
    if (is_guess)
        messages.push_back (Message::warning ("smartknob/torque", "",
                                              "the motor is taken to give " + inMillinewtons (fit.torque_per_volt) + " per volt, which is a guess",
                                              "measure it with a weight on a lever, and write --torque-per-volt \"5 mN*m\""));
    auto config = fit.config;
    config.text = stem.substr (0, longest_text);
    Json json { { "position", 0 },
                { "sub_position_unit", config.sub_position },
                { "min_position", config.min_position },
                { "max_position", config.max_position },
                { "position_width_radians", config.width },
                { "detent_strength_unit", config.detent_strength },
                { "endstop_strength_unit", config.endstop_strength },
                { "snap_point", config.snap_point },
                { "text", config.text } };
    std::string readme = "# " + stem + "\n\n";
    readme += "Detents for a [SmartKnob](https://github.com/scottbez1/smartknob), from a graph of Tactus. The firmware of the knob accepts no torque\n";
    readme += "commands: it computes its own torque from `" + stem + ".json` (its `SmartKnobConfig`, protocol version 1).\n";
    readme += "`" + stem + ".bin` is the message that sets it,\n";
    readme += "with a leading 0, which switches the knob to this protocol:\n\n";
    readme += "```sh\nstty -F /dev/ttyUSB0 115200 raw -echo\ncat " + stem + ".bin > /dev/ttyUSB0\n```\n\n| | |\n|---|---|\n";
    readme += "| largest torque of the graph | " + inMillinewtons (fit.largest) + " |\n";
    readme += "| difference of the knob's torque, root mean square | " + inMillinewtons (fit.rms) + " |\n";
    readme += "| torque of the motor per volt | " + inMillinewtons (fit.torque_per_volt) + (is_guess ? ", a guess" : "") + " |\n\n";
    readme += "The knob damps its own motion, and shifts its detents slowly to where it rests. These numbers include neither.\n";
    readme += "Of the limits of the role, the export keeps the largest torque. The firmware has no guard: it does not keep the others.\n";
    return { { stem + ".json", json.dump (2) + "\n" }, { stem + ".bin", knobMessage (config) }, { "README.md", readme } };
}

}   // namespace tactus::host
