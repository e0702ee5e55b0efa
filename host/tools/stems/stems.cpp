// SPDX-License-Identifier: GPL-3.0-or-later
#include "stems.hpp"
#include "stem_clips.hpp"

#include <host/base/platform/atomic_folder.hpp>
#include <host/devices/audio/listening.hpp>
#include <host/devices/audio/resample_file.hpp>
#include <tactus/kit/random.hpp>
#include <tactus/kit/signal/mixing_desk.hpp>
#include <tactus/run/probe_ring.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <span>
#include <utility>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

constexpr const char* list_of_files = "tactus_stems.txt";
constexpr double loudest = 0.8912509381337456;   // -1 dBFS
constexpr std::size_t most_samples = 100'000'000;

/// The ports of a mixer, by the row of its type.
plan::PortRef portOf (const plan::Flat& flat, int node, Role role, std::string_view id, int index = -1)
{
    const auto& rows = flat.node (node).ports (role);
    return { .node = node, .role = role, .port = static_cast<int> (std::ranges::find (rows, id, &PortSheet::id) - rows.begin()), .index = index };
}

std::vector<int> mixersIn (const std::vector<SinkMix>& mixes)
{
    std::set<int> all;
    for (const auto& m : mixes)
        all.insert (m.mixers.begin(), m.mixers.end());
    return { all.begin(), all.end() };
}

/// The layers that the setting `names` of a mixer lists.
std::vector<std::string> namesOf (const plan::FlatNode& mixer)
{
    std::vector<std::string> names (1);
    const auto& rows = mixer.type->settings;
    const auto row = std::ranges::find (rows, std::string_view ("names"), &SettingSheet::id);
    const auto* text = row == rows.end() ? nullptr : std::get_if<std::string> (&mixer.settings[static_cast<std::size_t> (row - rows.begin())]);
    for (const char c : text == nullptr ? std::string() : *text)
        if (c == ',')
            names.emplace_back();
        else if (c != ' ' || ! names.back().empty())
            names.back() += c;
    return names;
}

/// A text as a part of a file name: lower case letters, digits and underscores.
std::string asName (std::string_view text)
{
    std::string name;
    for (const char c : text)
    {
        const bool is_letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        const char plain = is_letter ? c : c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a')
                                                                : '_';
        if (plain != '_' || (! name.empty() && name.back() != '_')) name += plain;
    }
    while (name.ends_with ('_'))
        name.pop_back();
    return name.substr (0, 60);
}

/// A file before it is written.
struct Stem
{
    WrittenStem to {};
    std::vector<std::vector<float>> channels {};
    std::string role {};   ///< of the motor; "" if it is not known
};

/// The entry of a file in stems.json.
Json describe (const WrittenStem& s)
{
    const auto listOf = [] (const std::vector<std::string>& texts) {
        auto list = Json::array();
        for (const auto& t : texts)
            list.push_back (t);
        return list;
    };
    Json file { { "file", s.file }, { "kind", s.kind }, { "label", s.label }, { "from", s.from } };
    file["channels"] = listOf (s.channels);
    if (! s.not_applied.empty()) file["not_applied"] = listOf (s.not_applied);
    file["unit"] = s.unit;
    file["full_scale"] = s.full_scale;
    file["peak"] = s.peak;
    file["clipped"] = s.clipped;
    return file;
}

/// The taps of a port.
std::vector<std::size_t> tapsOf (const Plan& plan, const std::string& port)
{
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < plan.taps().size(); ++i)
        if (isPartOf (plan.taps()[i].name, port)) found.push_back (i);
    return found;
}

/// A mixer that is computed a second time beside the run, to find the share of each layer.
class Shadow
{
public:
    Shadow (const Plan& plan, int node)
        : path (plan.flat().node (node).path), is_vector (plan.flat().node (node).type->info.id == std::string_view ("layer.mix_vectors")),
          width (is_vector ? 3 : 1)
    {
        const auto& flat = plan.flat();
        const auto& of = flat.node (node);
        layers = of.list_size;
        for (int i = 0; i < layers; ++i)
            for (const auto tap : tapsOf (plan, flat.nameOf (portOf (flat, node, Role::input, "in", i))))
                in.push_back (&plan.taps()[tap]);
        for (const auto tap : tapsOf (plan, flat.nameOf (portOf (flat, node, Role::output, "out"))))
            out.push_back (&plan.taps()[tap]);
        const double speed = flat.speed (of.section);
        times = std::max (1, static_cast<int> (std::lround (speed)));
        period = std::max (1, static_cast<int> (std::lround (1.0 / speed)));
        numbers.prepare (1.0 / (plan.rateHz() * speed));
        vectors.prepare (1.0 / (plan.rateHz() * speed));
        const auto& instance = plan.instances()[static_cast<std::size_t> (node)];
        const auto knob = [&] (std::string_view id) {
            const auto row = static_cast<std::size_t> (portOf (flat, node, Role::param, id).port);
            return instance.param (plan::Knobs::indexOf (*of.type, row, 0));
        };
        given = { knob ("gain"), knob ("mute"), knob ("solo"), knob ("priority"), knob ("duck_db"), knob ("ceiling") };
        values.resize (in.size());
        for (const auto& v : values)
            sources.push_back (&v);
        made.resize (static_cast<std::size_t> (times) * in.size());
    }

    /// Computes the layers of a tick, the latest of the run.
    void tick (std::uint64_t number)
    {
        DeskParams params;
        for (int i = 0; i < layers; ++i)
        {
            params.gain[i] = given[0][i];
            params.mute[i] = given[1][i];
            params.solo[i] = given[2][i];
            params.priority[i] = given[3][i];
        }
        params.duck_db = *given[4];
        params.ceiling = *given[5];
        if (number % static_cast<std::uint64_t> (period) != 0) return;
        numbers.update (params, layers);
        vectors.update (params, layers);
        for (int t = 0; t < times; ++t)
        {
            for (std::size_t k = 0; k < in.size(); ++k)
                values[k] = in[k]->sample (t, times);
            is_vector ? mix (vectors, Vec3 {}, params, t) : mix (numbers, 0.0, params, t);
        }
    }

    /// The share of a layer in a component of the mix, at the i-th of n equal parts of the tick.
    double part (int layer, std::size_t component, int i, int n) const
    {
        const auto t = static_cast<std::size_t> (((i + 1) * times + n - 1) / n - 1);
        return made[t * in.size() + static_cast<std::size_t> (layer) * width + component];
    }

    const std::string path;
    const bool is_vector;
    const std::size_t width;
    int layers = 0;
    double difference = 0.0, peak = 0.0;   ///< between the mix of the run and the sum of the layers, the largest
    std::string unit() const { return out.empty() ? std::string() : out.front()->unit; }

private:
    template <typename Layer>
    struct Mixed
    {
        Layer out {};
        List level;
        double reduction = 0.0;
    };

    template <typename Layer>
    void mix (MixingDesk<Layer>& desk, Layer, const DeskParams& params, int t)
    {
        const auto mixed = desk.template mix<Mixed<Layer>> (InputList<Layer> (sources.data(), layers), params);
        const bool is_whole = std::ranges::all_of (values, [] (double v) { return std::isfinite (v); });
        auto* const to = made.data() + static_cast<std::size_t> (t) * in.size();
        for (int i = 0; i < layers; ++i)
            for (std::size_t c = 0; c < width; ++c)
            {
                const auto k = static_cast<std::size_t> (i) * width + c;
                to[k] = is_whole ? desk.factor (i, params) * values[k] * std::pow (10.0, -mixed.reduction / 20.0) : 0.0;
            }
        for (std::size_t c = 0; c < width && c < out.size(); ++c)
        {
            double sum = 0.0;
            for (int i = 0; i < layers; ++i)
                sum += to[static_cast<std::size_t> (i) * width + c];
            const double real = out[c]->sample (t, times);
            if (! std::isfinite (sum) || ! std::isfinite (real)) continue;
            difference = std::max (difference, std::abs (real - sum));
            peak = std::max (peak, std::abs (real));
        }
    }

    std::vector<const Tap*> in, out;
    int times = 1, period = 1;
    MixingDesk<double> numbers;
    MixingDesk<Vec3> vectors;
    std::array<const double*, 6> given {};
    std::vector<double> values, made;   // made: by sample of the tick, then as `in`
    std::vector<const double*> sources;
};

/// The sum of taps, each times a number, as one channel of a file.
struct Channel
{
    std::size_t stem, channel;
    std::vector<std::pair<const Tap*, double>> from;
};

/// A layer of a mixer, as the channels of a file.
struct Layer
{
    std::size_t stem, mixer;
    int layer;
};
}   // namespace

struct Stems::Impl
{
    const Plan& plan;
    StemOptions options;
    std::vector<Stem> stems;
    std::vector<Channel> channels;
    std::vector<Layer> layers;
    std::vector<Shadow> mixers;
    int per_tick = 1;
    std::size_t frames = 0;
    std::set<std::string> names;

    Impl (const Plan& p, const StemOptions& o) : plan (p), options (o)
    {
        for (const auto& tap : plan.taps())
            per_tick = std::max (per_tick, tap.per_tick);
        const auto mixes = sinkMixes (plan.flat());
        addMixes (mixes);
        for (const int m : mixersIn (mixes))
            mixers.emplace_back (plan, m);
        addLayers (mixes);
        addUnmixed (mixes);
    }

    std::size_t add (std::string kind, const std::string& name, std::string role)
    {
        auto file = name;
        for (int i = 2; ! names.insert (file).second; ++i)
            file = name + "_" + std::to_string (i);
        stems.push_back ({ .to = { .file = file + ".wav", .kind = std::move (kind) }, .role = std::move (role) });
        return stems.size() - 1;
    }

    void addChannel (std::size_t stem, const std::string& name, std::vector<std::pair<const Tap*, double>> from)
    {
        auto& s = stems[stem];
        if (s.channels.empty() && ! from.empty()) s.to.unit = from.front().first->unit;
        channels.push_back ({ stem, s.channels.size(), std::move (from) });
        s.channels.emplace_back();
        s.to.channels.push_back (name);
    }

    /// A file with the actuators of each role, in the order of their numbers, and a file for each of them.
    void addMixes (const std::vector<SinkMix>& mixes)
    {
        const auto& flat = plan.flat();
        struct Actuator
        {
            std::string name;
            std::vector<std::pair<const Tap*, double>> from;
        };
        std::map<std::string, std::map<std::pair<int, std::string>, Actuator>> roles;
        for (const auto& m : mixes)
        {
            const auto& node = flat.node (m.sink);
            const std::string port (flat.sheet (m.input).id);
            const auto parts = tapsOf (plan, m.name);
            for (std::size_t c = 0; c < parts.size(); ++c)
            {
                const auto& tap = plan.taps()[parts[c]];
                // Forces come first, then torques, the axes by their names and the channels by their numbers.
                std::pair<int, std::string> place { port == "force" ? 0 : port == "torque" ? 3
                                                                                           : 6,
                                                    {} };
                std::string called = port == "torque" ? "torque_" : "";
                if (parts.size() == 3)
                {
                    place.first += static_cast<int> (c);
                    called += "xyz"[c];
                }
                else if (const auto* axis = std::get_if<std::string> (&node.settings.front()))
                {
                    called = asName (*axis);
                    place.second = *axis;
                }
                else if (const auto* channel = std::get_if<double> (&node.settings.front()))
                {
                    called = "channel_" + numberText (*channel);
                    place.first += static_cast<int> (*channel);
                }
                auto& actuator = roles[node.role][place];
                actuator.name = called;
                actuator.from.emplace_back (&tap, 1.0);
            }
        }
        for (const auto& [role, actuators] : roles)
        {
            const auto name = roles.size() > 1 ? "mix_" + asName (role) : std::string ("mix");
            const auto whole = add ("mix", name, role);
            stems[whole].to.label = role;
            for (const auto& [place, a] : actuators)
                addChannel (whole, a.from.front().first->name, a.from);
            for (const auto& [place, a] : actuators)
                if (actuators.size() > 1)
                {
                    const auto one = add ("axis", name + "_" + a.name, role);
                    stems[one].to.label = a.name;
                    addChannel (one, a.from.front().first->name, a.from);
                }
        }
    }

    std::string roleOf (const SinkMix& m) const { return plan.flat().node (m.sink).role; }

    void addLayers (const std::vector<SinkMix>& mixes)
    {
        const auto& flat = plan.flat();
        const auto numbers = mixersIn (mixes);
        for (std::size_t m = 0; m < mixers.size(); ++m)
        {
            const auto to = std::ranges::find_if (mixes, [&] (const SinkMix& s) { return std::ranges::count (s.mixers, numbers[m]) > 0; });
            const auto called = namesOf (flat.node (numbers[m]));
            for (int i = 0; i < mixers[m].layers; ++i)
            {
                const auto label = static_cast<std::size_t> (i) < called.size() ? called[static_cast<std::size_t> (i)] : std::string();
                auto name = "layer_" + (mixers.size() > 1 ? asName (mixers[m].path) + "_" : std::string()) + std::to_string (i + 1);
                if (! asName (label).empty()) name += "_" + asName (label);
                const auto stem = add ("layer", name, roleOf (*to));
                auto& s = stems[stem];
                s.to.label = label;
                s.to.from = mixers[m].path + ".in[" + std::to_string (i) + "]";
                s.to.unit = mixers[m].unit();
                for (std::size_t c = 0; c < mixers[m].width; ++c)
                    s.to.channels.push_back (mixers[m].width > 1 ? s.to.from + "." + "xyz"[c] : s.to.from);
                s.channels.resize (mixers[m].width);
                layers.push_back ({ stem, m, i });
            }
        }
    }

    void addUnmixed (const std::vector<SinkMix>& mixes)
    {
        for (const auto& m : mixes)
            for (const auto& u : m.unmixed)
            {
                const auto parts = u.from.empty() ? std::vector<std::size_t> {} : tapsOf (plan, u.from);
                if (parts.empty()) continue;
                const auto stem = add ("not_mixed", "not_mixed_" + asName (u.from), roleOf (m));
                stems[stem].to.from = u.from;
                stems[stem].to.label = plan.flat().nameOf (plan.flat().wires[u.wire].to);
                for (const int n : u.through)
                    stems[stem].to.not_applied.push_back (plan.flat().node (n).path);
                for (const auto p : parts)
                    addChannel (stem, plan.taps()[p].name, { { &plan.taps()[p], plan.flat().wires[u.wire].gain } });
            }
    }

    void take()
    {
        for (auto& m : mixers)
            m.tick (plan.nextTick() - 1);
        for (int i = 0; i < per_tick; ++i)
        {
            for (const auto& c : channels)
            {
                double sum = 0.0;
                for (const auto& [tap, gain] : c.from)
                    sum += gain * tap->sample (i, per_tick);
                stems[c.stem].channels[c.channel].push_back (static_cast<float> (sum));
            }
            for (const auto& l : layers)
                for (std::size_t c = 0; c < mixers[l.mixer].width; ++c)
                    stems[l.stem].channels[c].push_back (static_cast<float> (mixers[l.mixer].part (l.layer, c, i, per_tick)));
        }
        frames += static_cast<std::size_t> (per_tick);
    }

    double ownRate() const { return plan.rateHz() * per_tick; }

    /// Turns each vector into its component in the main direction of the mix of its role, if this mix is a vector. All else stays as it is.
    void fold()
    {
        std::map<std::string, std::vector<double>> directions;
        for (const auto& s : stems)
        {
            if (s.to.kind != "mix" || s.channels.size() != 3) continue;
            const std::vector<const std::vector<float>*> force { &s.channels[0], &s.channels[1], &s.channels[2] };
            directions[s.role] = mainDirection (force);
        }
        for (auto& s : stems)
        {
            const auto direction = directions.find (s.role);
            if (s.channels.size() != 3 || direction == directions.end() || direction->second.empty()) continue;
            for (std::size_t k = 0; k < frames; ++k)
            {
                double sum = 0.0;
                for (std::size_t c = 0; c < 3; ++c)
                    sum += direction->second[c] * double { s.channels[c][k] };
                s.channels[0][k] = static_cast<float> (sum);
            }
            s.channels.resize (1);
            const auto& along = direction->second;
            s.to.channels = { "along " + numberText (along[0]) + " " + numberText (along[1]) + " " + numberText (along[2]) };
        }
    }

    /// Blends the samples after the end of the loop into its start, so that the end continues at the start. The weights add up to 1, so a constant force
    /// stays constant.
    Result<> loop (double to_hz)
    {
        const auto blend = static_cast<std::size_t> (std::lround (options.loop_s * ownRate()));
        auto length = frames - std::min (blend, frames);
        // A whole number of samples at the new rate, too.
        const auto from = static_cast<std::uint64_t> (std::lround (ownRate())), to = static_cast<std::uint64_t> (std::lround (to_hz));
        length -= length % static_cast<std::size_t> (from / std::gcd (from, to));
        if (blend == 0 || length <= blend)
            return Message::error ("stems/loop", {}, "the run is too short for a loop with a blend of " + numberText (options.loop_s) + " s",
                                   "run for more than twice this time, or blend over a shorter one");
        for (auto& s : stems)
            for (auto& c : s.channels)
            {
                for (std::size_t k = 0; k < blend; ++k)
                {
                    const double w = 0.5 - 0.5 * std::cos (std::numbers::pi * (static_cast<double> (k) + 0.5) / static_cast<double> (blend));
                    c[k] = static_cast<float> (w * double { c[k] } + (1.0 - w) * double { c[length + k] });
                }
                c.resize (length);
            }
        frames = length;
        return {};
    }

    void resample (double to_hz)
    {
        if (to_hz == ownRate()) return;
        const auto wanted = static_cast<std::size_t> (std::llround (static_cast<double> (frames) * to_hz / ownRate()));
        for (auto& s : stems)
            for (auto& c : s.channels)
            {
                // A loop is extended by itself, a run by its first and its last value.
                const bool is_loop = options.loop_s > 0.0;
                const std::size_t around = is_loop ? frames : static_cast<std::size_t> (std::lround (0.05 * ownRate())) + 1;
                std::vector<float> longer;
                longer.reserve (frames + 2 * around);
                is_loop ? longer.insert (longer.end(), c.begin(), c.end()) : longer.insert (longer.end(), around, c.front());
                longer.insert (longer.end(), c.begin(), c.end());
                is_loop ? longer.insert (longer.end(), c.begin(), c.end()) : longer.insert (longer.end(), around, c.back());
                auto made = audio::resampled (std::move (longer), ownRate(), to_hz);
                const auto first = static_cast<std::size_t> (std::llround (static_cast<double> (around) * to_hz / ownRate()));
                made.resize (std::max (made.size(), first + wanted), made.empty() ? 0.0f : made.back());
                c.assign (made.begin() + static_cast<std::ptrdiff_t> (first), made.begin() + static_cast<std::ptrdiff_t> (first + wanted));
            }
        frames = wanted;
    }

    void findScale()
    {
        double most = 0.0;
        for (auto& s : stems)
        {
            for (const auto& c : s.channels)
                for (const float v : c)
                    if (std::isfinite (v)) s.to.peak = std::max (s.to.peak, std::abs (double { v }));
            most = std::max (most, s.to.peak);
        }
        for (auto& s : stems)
        {
            const double peak = options.scale == StemOptions::Scale::each ? s.to.peak : most;
            s.to.full_scale = options.scale == StemOptions::Scale::physical ? options.full_scale : peak > 0.0 ? peak / loudest
                                                                                                              : 1.0;
        }
    }

    /// The clips of the layers and of what is not mixed, with their texts.
    Result<std::vector<std::pair<WrittenStem, std::string>>> clips (Messages& losses) const
    {
        std::vector<std::pair<const Stem*, OneSignal>> parts;
        double most = 0.0;
        for (const auto& s : stems)
            if (! options.clips.empty() && (s.to.kind == "layer" || s.to.kind == "not_mixed"))
                most = std::max (most, parts.emplace_back (&s, oneSignalOf (s.channels, s.to.channels)).second.peak);
        std::vector<std::pair<WrittenStem, std::string>> made;
        for (const auto& [s, signal] : parts)
            for (const auto& format : options.clips)
            {
                WrittenStem to { .file = fs::path (s->to.file).replace_extension (format).string(), .kind = "clip", .label = s->to.label, .from = s->to.from };
                to.channels = { signal.channel };
                to.not_applied = s->to.not_applied;
                to.unit = s->to.unit;
                const double peak = options.scale == StemOptions::Scale::each ? signal.peak : most;
                to.full_scale = peak > 0.0 ? peak : 1.0;
                to.peak = signal.peak;
                Messages lost;
                const auto label = s->to.label.empty() ? s->to.from : s->to.label;
                auto text = clipTextOf (signal, ownRate(), to.full_scale, label, format, lost);
                if (! text) return std::move (text).error();
                for (auto& m : lost)
                {
                    m.where = '.' + format;
                    const auto isSame = [&] (const Message& known) { return known.where == m.where && known.text == m.text; };
                    if (std::ranges::none_of (losses, isSame)) losses.push_back (std::move (m));
                }
                made.emplace_back (std::move (to), std::move (*text));
            }
        return made;
    }

    std::string bytesOf (Stem& s, double rate_hz) const
    {
        const auto format = options.format;
        auto out = wavHeader (rate_hz, s.channels.size(), frames, format);
        const int bytes = static_cast<int> (host::bytesOf (format));
        const double top = format == SampleFormat::pcm16 ? 32767.0 : 8388607.0;
        Random random { 1 };
        for (std::size_t k = 0; k < frames; ++k)
            for (const auto& c : s.channels)
            {
                const double v = std::isfinite (c[k]) ? double { c[k] } / s.to.full_scale : 0.0;
                if (std::abs (v) > 1.0 + 1e-9) ++s.to.clipped;
                if (format == SampleFormat::float32)
                {
                    appendInteger (out, std::bit_cast<std::uint32_t> (static_cast<float> (v)), bytes);
                    continue;
                }
                const double noise = options.has_dither && s.to.peak > 0.0 ? random.uniform() + random.uniform() - 1.0 : 0.0;
                appendInteger (out, static_cast<std::uint32_t> (std::lround (std::clamp (v * top + noise, -top - 1.0, top))), bytes);
            }
        if (out.size() % 2 == 1) out += '\0';
        return out;
    }
};

std::vector<std::string> Stems::portsOf (const plan::Flat& flat)
{
    const auto mixes = sinkMixes (flat);
    std::vector<std::string> ports;
    const auto add = [&] (const std::string& port) {
        if (! port.empty() && std::ranges::count (ports, port) == 0) ports.push_back (port);
    };
    for (const auto& m : mixes)
    {
        add (m.name);
        for (const auto& u : m.unmixed)
            add (u.from);
    }
    for (const int m : mixersIn (mixes))
    {
        for (int i = 0; i < flat.node (m).list_size; ++i)
            add (flat.nameOf (portOf (flat, m, Role::input, "in", i)));
        add (flat.nameOf (portOf (flat, m, Role::output, "out")));
    }
    return ports;
}

Stems::Stems (const Plan& run, const StemOptions& options) : impl (std::make_unique<Impl> (run, options)) {}
Stems::~Stems() = default;

Result<> Stems::frame()
{
    std::size_t width = 0;
    for (const auto& s : impl->stems)
        width += s.channels.size();
    if ((impl->frames + static_cast<std::size_t> (impl->per_tick)) * width > most_samples)
        return Message::error ("stems/too_long", {}, "the stems of this run have more than " + std::to_string (most_samples) + " samples",
                               "render a shorter run");
    impl->take();
    return {};
}

Result<> Stems::check (const fs::path& folder) { return AtomicFolder::check (folder, list_of_files); }

Result<WrittenStems> Stems::write (const fs::path& folder, const std::string& name)
{
    auto& s = *impl;
    if (s.stems.empty() || s.frames == 0)
        return Message::error ("stems/nothing", {}, "nothing is wired into a motor, so there are no stems", "wire a force or a vibration to a device node");
    const double rate_hz = s.options.rate_hz > 0.0 ? s.options.rate_hz : s.ownRate();
    if (! (rate_hz >= 1.0 && rate_hz <= 768e3) || std::floor (rate_hz) != rate_hz)
        return Message::error ("wav/sample_rate", {}, "a WAV file cannot have a sample rate of " + roundedText (rate_hz, 12) + " Hz",
                               "choose a rate in whole Hz, up to 768 kHz");
    if (s.options.is_mono) s.fold();
    if (s.options.loop_s > 0.0)
        if (auto looped = s.loop (rate_hz); ! looped) return looped.error();
    Messages losses;
    const auto clips = s.clips (losses);
    if (! clips) return clips.error();
    s.resample (rate_hz);
    s.findScale();

    auto made = AtomicFolder::create (folder, list_of_files);
    if (! made) return std::move (made).error();
    WrittenStems written { .rate_hz = rate_hz, .frames = s.frames };
    written.losses = std::move (losses);
    std::string list;
    auto files = Json::array(), sums = Json::array();
    const auto note = [&] (const WrittenStem& to) {
        list += to.file + '\n';
        files.push_back (describe (to));
        written.files.push_back (to);
    };
    for (auto& stem : s.stems)
    {
        if (auto done = made->write (stem.to.file, s.bytesOf (stem, rate_hz)); ! done) return done.error();
        note (stem.to);
    }
    for (const auto& [to, text] : *clips)
    {
        if (auto done = made->write (to.file, text); ! done) return done.error();
        note (to);
    }
    for (const auto& m : s.mixers)
    {
        written.sums.push_back ({ m.path, m.unit(), m.difference, m.peak });
        sums.push_back (Json { { "mixer", m.path }, { "unit", m.unit() }, { "largest_difference", m.difference }, { "peak", m.peak } });
    }
    Json said { { "format", "tactus-stems" }, { "version", 1 }, { "name", name }, { "rate_hz", rate_hz }, { "frames", s.frames } };
    said["loop_blend_s"] = s.options.loop_s;
    said["files"] = files;
    said["sums"] = sums;
    if (auto done = made->write ("stems.json", said.dump (2) + "\n"); ! done) return done.error();
    if (auto done = made->write (list_of_files, list + "stems.json\n"); ! done) return done.error();
    if (auto kept = made->keepOthers(); ! kept) return kept.error();
    if (auto done = made->commit(); ! done) return done.error();
    return written;
}

}   // namespace tactus::host
