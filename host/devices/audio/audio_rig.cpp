// SPDX-License-Identifier: MIT
#include "audio_rig.hpp"

#include <tactus/run/probe_ring.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <thread>
#include <utility>

namespace tactus::host::audio
{
namespace
{
constexpr double longest_fall_s = 0.5;   // the longest stop that checkStops() allows a slew limit
}

AudioRig::AudioRig (AudioSettings settings, CardSystem& system) : wanted (std::move (settings)), cards (system), keeper (system, *this) {}

AudioClock& AudioRig::tickBy (double tick_rate_hz)
{
    own_clock = std::make_unique<AudioClock> (tick_rate_hz);
    return *own_clock;
}

std::unique_ptr<AudioDevice> AudioRig::open (AudioRole role, Messages& messages)
{
    if (has_begun)
    {
        messages.push_back (Message::error ("audio/late", "", "the sound card is already open and cannot take another role", "restart the run"));
        return nullptr;
    }
    auto device = std::make_unique<AudioDevice> (std::move (role), plays, [this] (const AudioDevice& gone) { std::erase (devices, &gone); });
    devices.push_back (device.get());
    return device;
}

Result<> AudioRig::nameCard (const std::string& name)
{
    const auto named = parseCard (name, cards.types());
    auto& card = wanted.card;
    if (card.type.empty() && card.output.empty())
    {
        card.type = named.type;
        card.output = named.output;
        return {};
    }
    if (card.type == named.type && card.output == named.output) return {};
    const auto first = card.type + (card.type.empty() || card.output.empty() ? "" : ":") + card.output;
    return Message::error ("audio/two_cards", "/card", "both " + quote (name) + " and " + quote (first) + " are requested, but a run has one sound card",
                           "name the same card everywhere, or name a card only once");
}

std::vector<std::string> AudioRig::ports() const
{
    std::vector<std::string> all;
    for (const auto& route : wanted.routes)
        all.push_back (route.port);
    return all;
}

bool AudioRig::isOptional (const std::string& port) const
{
    return lenient || std::ranges::any_of (wanted.routes, [&] (const Route& r) { return r.port == port && r.if_there; });
}

Messages AudioRig::begin (const Plan& plan, double tick_rate_hz, const Engine* e)
{
    tick_hz = tick_rate_hz;
    engine = e;
    for (auto& limit : limits)
        limit.clear();
    for (auto* device : devices)
        device->tighten (limits);
    std::vector<int> per_tick;
    std::vector<Route> played;
    auto messages = chooseRoutes (plan, played, per_tick);
    if (hasErrors (messages)) return messages;

    makeStreams (played, per_tick);
    mixer = std::make_unique<PortMixer> (played, per_tick, tick_hz);
    has_begun = true;
    if (auto opened = openCard (played); ! opened) messages.push_back (std::move (opened).error());
    return messages;
}

/// Finds the routes that this plan can play, each with its number of samples per tick. Returns what is wrong with the others.
Messages AudioRig::chooseRoutes (const Plan& plan, std::vector<Route>& played, std::vector<int>& per_tick) const
{
    Messages messages;
    for (const auto& route : wanted.routes)
    {
        const auto samples = PortMixer::samplesOf (plan, route);
        const auto from = messages.size();
        if (samples == 0)
            messages.push_back (Message::error ("audio/port", route.where, "there is no port " + quote (route.port),
                                                "name an output of a node, as in mix.out or drag.force.x; `tactus nodes TYPE` lists them"));
        for (const auto& tap : plan.taps())
            if (isPartOf (tap.name, route.port))
                if (const auto wrong = unitProblem (route.full_scale, tap.unit); ! wrong.empty())
                {
                    const auto remedy = "calibrate the channel in " + tap.unit + ", or leave the unit out";
                    messages.push_back (Message::error ("audio/unit", route.where, tap.name + ": " + wrong, remedy));
                    break;
                }
        if (route.if_there)
            for (auto i = from; i < messages.size(); ++i)
                messages[i].severity = Message::Severity::warning;
        if (samples > 0 && messages.size() > from) continue;   // the unit is wrong, so the route is not played
        played.push_back (route);
        per_tick.push_back (std::max (1, samples));
    }
    return messages;
}

Result<> AudioRig::openCard (const std::vector<Route>& played)
{
    int outs = 0, ins = 0;
    for (const auto& route : played)
        outs = std::max (outs, route.channel);
    for (const auto* device : devices)
    {
        for (const auto& use : device->uses().outputs)
            outs = std::max (outs, use.channel);
        for (const auto& use : device->uses().inputs)
            ins = std::max (ins, use.channel);
    }
    if (outs == 0 && ins == 0) outs = 1;   // a card that ticks the run must be open, even if no channel is used
    auto opened = keeper.open (wanted.card, outs, ins);
    if (! opened || fits) return opened;
    keeper.close();
    return Message::error ("audio/rate", "",
                           "the tick rate of " + numberText (tick_hz) + " Hz is too far from the " + numberText (format.rate_hz) + " Hz of the card",
                           "use a tick rate of at least " + numberText (std::ceil (format.rate_hz / 256.0)) + " Hz");
}

void AudioRig::makeStreams (const std::vector<Route>& routes, const std::vector<int>& per_tick)
{
    std::map<int, std::set<int>> used;   // channels, keyed by samples per tick
    for (std::size_t i = 0; i < routes.size(); ++i)
        used[per_tick[i]].insert (routes[i].channel - 1);
    std::set<int> in;
    for (const auto* device : devices)
    {
        for (const auto& use : device->uses().outputs)
            used[1].insert (use.channel - 1);
        for (const auto& use : device->uses().inputs)
            in.insert (use.channel - 1);
    }
    lanes.clear();
    for (const auto& [n, all] : used)
        lanes.push_back (std::make_unique<Lanes> (n, std::vector<int> (all.begin(), all.end()), tick_hz, wanted.reserve_s));
    heard_channels.assign (in.begin(), in.end());
    heard = in.empty() ? nullptr : std::make_unique<InStream> (StreamSetup { static_cast<int> (in.size()), tick_hz, wanted.reserve_s });
}

void AudioRig::begin (const OpenedFormat& opened)
{
    format = opened;
    const CardFormat f { opened.rate_hz, opened.block, own_clock ? Clocks::one : Clocks::apart };
    fits = Resampler::canDo (opened.rate_hz / tick_hz);
    for (const auto& l : lanes)
        fits = fits && Resampler::canDo (opened.rate_hz / (tick_hz * l->per_tick));
    if (! fits) return;
    for (auto& l : lanes)
    {
        l->stream.prepare (f);
        l->block.resize (l->channels.size() * static_cast<std::size_t> (opened.block));
    }
    if (heard) heard->prepare (f);
    heard_block.resize (heard_channels.size() * static_cast<std::size_t> (opened.block));
    const double silence = std::max (CardKeeper::silence_s, CardKeeper::silence_blocks * opened.block / opened.rate_hz);
    ticks_of_silence = static_cast<std::uint64_t> (silence * tick_hz) + 1;
    last_block = {};
    passed_time = PassedTime (opened.block / opened.rate_hz);
    for (auto& limit : limits)
        limit.restart();
    if (! capture || opened.rate_hz == capture_rate) return;
    captures = nullptr;
    capture_result =
        Message::error ("audio/capture_rate", format.name,
                        "the card came back at a different rate, " + numberText (opened.rate_hz) + " Hz, so the recording of its output ended",
                        "the part that was recorded before is kept; to record more, restart the run");
}

Result<> AudioRig::captureTo (const std::filesystem::path& path)
{
    auto made = CardCapture::create (path, format.rate_hz, std::max (1, format.outputs));
    if (! made) return std::move (made).error();
    capture = std::move (*made);
    capture_rate = format.rate_hz;
    captures.store (capture.get(), std::memory_order_release);
    return {};
}

//==============================================================================
void AudioRig::before() noexcept
{
    const auto blocks = keeper.blocks();
    ticks_without = blocks != blocks_seen ? 0 : ticks_without + 1;
    const bool hears = blocks > 0 && ticks_without <= ticks_of_silence.load (std::memory_order_relaxed);
    blocks_seen = blocks;
    plays.store (hears, std::memory_order_relaxed);
    if (heard)
    {
        const auto frame = heard->pop();
        for (std::size_t i = 0; i < frame.size(); ++i)
            inputs[static_cast<std::size_t> (heard_channels[i])] = frame[i];
        for (auto* device : devices)
            device->hear (inputs);
    }
}

void AudioRig::after (const Plan& plan, bool halts) noexcept
{
    if (! mixer) return;
    mixer->poll (plan, halts || (engine != nullptr && engine->isEmergency()));
    for (auto& l : lanes)
        for (int i = 0; i < l->per_tick; ++i)
        {
            channels.fill (0.0);
            mixer->addTo (channels, i, l->per_tick);
            if (l->per_tick == 1)
                for (const auto* device : devices)
                    device->addTo (channels);
            for (std::size_t lane = 0; lane < l->channels.size(); ++lane)
                l->frame[lane] =
                    static_cast<float> (std::clamp (channels[static_cast<std::size_t> (l->channels[lane])], -PortMixer::most_sample, PortMixer::most_sample));
            l->stream.push (l->frame);
        }
}

//==============================================================================
void AudioRig::block (const float* const* in, int ins, float* const* out, int outs, int frames) noexcept
{
    const auto now = cards.now();
    const double since = std::chrono::duration<double> (now - last_block).count();
    if (last_block != std::chrono::steady_clock::time_point {} && since > 2.0 * frames / format.rate_hz + wanted.reserve_s)
        late_blocks.fetch_add (1, std::memory_order_relaxed);
    last_block = now;
    // A card may play faster than it says. Its channels are limited by the time that has passed.
    const double passed = std::min (passed_time (std::chrono::duration<double> (now.time_since_epoch()).count(), 0.0), frames / format.rate_hz);

    for (int c = 0; c < outs; ++c)
        std::fill_n (out[c], frames, 0.0f);
    if (! fits) return;
    for (int from = 0; from < frames; from += format.block)
        play (in, ins, out, outs, from, std::min (format.block, frames - from));
    for (int c = 0; c < outs; ++c)
    {
        clip (out[c], frames);
        if (c < most_channels) limits[static_cast<std::size_t> (c)](out[c], frames, passed / frames);
    }
    if (auto* to = captures.load (std::memory_order_acquire)) to->note (out, outs, frames);
}

void AudioRig::play (const float* const* in, int ins, float* const* out, int outs, int from, int frames) noexcept
{
    const auto count = static_cast<std::size_t> (frames);
    if (heard)
    {
        const auto width = heard_channels.size();
        for (std::size_t lane = 0; lane < width; ++lane)
        {
            const int c = heard_channels[lane];
            for (std::size_t i = 0; i < count; ++i)
            {
                const float sample = c < ins && in[c] != nullptr ? in[c][static_cast<std::size_t> (from) + i] : 0.0f;
                heard_block[i * width + lane] = std::isfinite (sample) ? sample : 0.0f;
            }
        }
        heard->take (std::span (heard_block).first (count * width));
    }
    if (own_clock) own_clock->block (frames, format.rate_hz);
    for (auto& l : lanes)
    {
        const auto width = l->channels.size();
        const auto samples = std::span (l->block).first (count * width);
        l->stream.render (samples);
        for (std::size_t lane = 0; lane < width; ++lane)
            if (const int c = l->channels[lane]; c < outs)
                for (std::size_t i = 0; i < count; ++i)
                    out[c][static_cast<std::size_t> (from) + i] += samples[i * width + lane];
    }
}

void AudioRig::clip (float* samples, int frames) noexcept
{
    std::uint64_t beyond = 0;
    for (int i = 0; i < frames; ++i)
    {
        beyond += std::abs (samples[i]) > 1.0f ? 1u : 0u;
        samples[i] = std::clamp (samples[i], -1.0f, 1.0f);
    }
    if (beyond > 0) clipped.fetch_add (beyond, std::memory_order_relaxed);
}

//==============================================================================
Result<> AudioRig::poll (CardKeeper::Clock::time_point now)
{
    keeper.poll (now);
    if (! capture) return {};
    if (auto drained = capture->drain(); ! drained) return drained;
    return std::exchange (capture_result, {});
}

/// Waits until the samples still in the streams have been played, so that the end of the sound is not cut off.
void AudioRig::playRest() const
{
    using namespace std::chrono_literals;
    auto last = std::chrono::steady_clock::now();
    auto seen = keeper.blocks();
    const auto flows = [&] { return std::ranges::any_of (lanes, [] (const auto& l) { return l->stream.report().flows != 0; }); };
    const auto goes = [&]   // blocks still arrive
    {
        const auto now = std::chrono::steady_clock::now();
        if (const auto n = keeper.blocks(); n != seen)
        {
            seen = n;
            last = now;
        }
        return keeper.isOpen() && now - last < 2s * format.block / format.rate_hz + 20ms;
    };
    while (goes() && flows())
        std::this_thread::sleep_for (1ms);
    double fall = 0.0;
    for (const auto& limit : limits)
        fall = std::max (fall, std::min (limit.fall(), longest_fall_s));
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double> (OutStream::fade_out_s + fall + 2.0 * format.block / format.rate_hz);
    while (goes() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for (1ms);
}

Result<> AudioRig::end()
{
    playRest();
    keeper.close();
    captures = nullptr;
    if (! capture) return {};
    return std::exchange (capture, nullptr)->commit();
}

bool AudioRig::limitsFirst (int count) const noexcept
{
    return std::ranges::any_of (std::span (limits).first (static_cast<std::size_t> (std::clamp (count, 0, most_channels))), &ChannelLimit::isSet);
}

AudioStatus AudioRig::status() const
{
    AudioStatus s { .is_open = keeper.isOpen(), .card = keeper.format() };
    for (const auto& l : lanes)
    {
        const auto report = l->stream.report();
        s.out.underruns += report.underruns;
        s.out.overruns += report.overruns;
        s.out.latency_s = std::max (s.out.latency_s, report.latency_s);
        if (std::abs (report.error_s) >= std::abs (s.out.error_s)) s.out.error_s = report.error_s;
        s.out.difference = report.difference;
        s.out.flows = std::max (s.out.flows, report.flows);
    }
    if (heard) s.in = heard->report();
    s.ratio = 1.0 + (lanes.empty() ? s.in.difference : s.out.difference);
    s.blocks = keeper.blocks();
    s.xruns = keeper.xruns();
    s.late_blocks = late_blocks.load (std::memory_order_relaxed);
    s.departures = keeper.departures();
    s.clipped = clipped.load (std::memory_order_relaxed);
    s.not_numbers = mixer ? mixer->notNumbers() : 0;
    s.by_timer = own_clock && own_clock->isReplaced();
    s.ticks_by_timer = own_clock ? own_clock->ticksByTimer() : 0;
    if (const auto& opened = keeper.lastAttempt(); ! opened) s.trouble = opened.error().text;
    return s;
}

}   // namespace tactus::host::audio
