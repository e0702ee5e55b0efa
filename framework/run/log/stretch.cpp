// SPDX-License-Identifier: MIT
#include "stretch.hpp"

#include <tactus/text/budget.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus
{

namespace
{
/// The tick at a time. A time between two ticks gives the later tick.
std::uint64_t tickAt (double s, double rate_hz)
{
    const double ticks = std::ceil (s * rate_hz - 1e-6);
    constexpr double last = 1e15;
    return static_cast<std::uint64_t> (std::clamp (ticks, 0.0, last));
}

std::vector<std::string> columnsOf (const DeviceLayout& has)
{
    std::vector<std::string> columns { "t", "x", "y", "z", "rx", "ry", "rz", "pressure" };
    for (std::size_t i = 0; i < has.buttons.size(); ++i)
        columns.push_back ("button" + std::to_string (i));
    std::ranges::copy (has.axes, std::back_inserter (columns));
    for (int i = 1; i <= has.signal_inputs; ++i)
        columns.push_back ("signal" + std::to_string (i));
    return columns;
}

std::vector<std::string> rolesIn (const Plan& plan)
{
    std::vector<std::string> names;
    for (const auto& role : plan.roles())
        names.push_back (role.name);
    return names;
}
}   // namespace

std::string StretchReader::firstRole() const
{
    const auto roles = rolesIn (replay->run().engine().plan());
    return roles.empty() ? std::string() : roles.front();
}

StretchReader::StretchReader (std::unique_ptr<Replay> r, const Options& options, std::string l)
    : replay (std::move (r)), log (std::move (l)), role (options.role)
{
}

Result<std::unique_ptr<StretchReader>> StretchReader::open (const std::string& log, const Options& options)
{
    auto replay = Replay::open (log, { .records = options.records, .assets = options.assets, .services = options.services, .program = options.program });
    if (! replay) return replay.error();
    std::unique_ptr<StretchReader> reader { new StretchReader (std::move (*replay), options, log) };
    if (auto begun = reader->begin (options); ! begun) return begun.error();
    return reader;
}

Result<> StretchReader::begin (const Options& options)
{
    if (! (options.until_s > options.from_s))
        return Message::error ("take/empty", log, "the stretch from " + numberText (options.from_s) + " s to " + numberText (options.until_s) + " s is empty",
                               "choose an end after the start");
    kept.rate_hz = replay->rate();
    kept.from = tickAt (options.from_s, kept.rate_hz);
    kept.until = std::isfinite (options.until_s) ? tickAt (options.until_s, kept.rate_hz) : std::numeric_limits<std::uint64_t>::max();
    for (const auto& tap : taps())
        kept.names.push_back (tap.name);
    if (! taps().empty()) kept.quantity = taps().front().quantity;
    if (! taps().empty()) kept.unit = taps().front().unit;
    if (role.empty()) return {};
    const auto roles = rolesIn (replay->run().engine().plan());
    if (std::ranges::count (roles, role) == 0)
        return Message::error ("take/role", log, "the run has no role " + quote (role) + didYouMean (role, roles), "name a role of its graph");
    kept.columns = columnsOf (hand()->layout);
    return {};
}

const DeviceState* StretchReader::hand() const
{
    for (const auto& r : replay->run().engine().plan().roles())
        if (r.name == role) return r.state.get();
    return nullptr;
}

Result<bool> StretchReader::advance (std::uint64_t ticks)
{
    for (; ticks > 0; --ticks)
    {
        if (now >= kept.until) return false;
        const auto played = replay->tick();
        if (! played) return played.error();
        if (! *played)
        {
            kept.until = now;
            return false;
        }
        if (now >= kept.from) keep();
        ++now;
        if (const auto numbers = static_cast<double> (kept.values.size() + kept.movement.size()); numbers > budgets().numbers)
            return overBudget ("take/too_large", &Budgets::numbers, "the stretch", numbers, "take a shorter stretch, or record fewer ports");
    }
    return now < kept.until;
}

void StretchReader::keep()
{
    const auto& all = taps();
    for (std::size_t i = 0; i < kept.names.size(); ++i)
        kept.values.push_back (i < all.size() ? *all[i].value : 0.0);
    if (! kept.columns.empty()) keepMovement();
}

void StretchReader::keepMovement()
{
    const auto begin = kept.movement.size();
    const auto put = [this] (double v) { kept.movement.push_back (v); };
    put (static_cast<double> (now - kept.from) / kept.rate_hz);
    if (const auto* state = hand(); state != nullptr)
    {
        const auto& reading = state->reading;
        for (int i = 0; i < 3; ++i)
            put (reading.valid ? reading.position[i] : std::numeric_limits<double>::quiet_NaN());
        for (int i = 0; i < 3; ++i)
            put (reading.rotation[i]);
        put (reading.pressure);
        for (std::size_t i = 0; i < state->layout.buttons.size(); ++i)
            put (static_cast<double> (reading.buttons >> i & 1u));
        for (std::size_t i = 0; i < state->layout.axes.size(); ++i)
            put (reading.axes[static_cast<int> (i)]);
        for (int i = 0; i < state->layout.signal_inputs; ++i)
            put (reading.signals[i]);
    }
    kept.movement.resize (begin + kept.columns.size(), 0.0);
}

Result<Stretch> StretchReader::take()
{
    if (now <= kept.from)
        return Message::error ("take/empty", log, "the run ends at " + numberText (static_cast<double> (now) / kept.rate_hz) + " s, before the stretch begins",
                               "choose an earlier stretch");
    kept.until = now;
    return std::move (kept);
}

Result<Stretch> readStretch (const std::string& log, StretchReader::Options options, Messages& warnings)
{
    auto reader = StretchReader::open (log, std::move (options));
    if (! reader) return reader.error();
    for (;;)
    {
        const auto more = (*reader)->advance (10'000);
        std::ranges::move ((*reader)->takeWarnings(), std::back_inserter (warnings));
        if (! more) return more.error();
        if (! *more) return (*reader)->take();
    }
}

}   // namespace tactus
