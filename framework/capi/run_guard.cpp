// SPDX-License-Identifier: MIT
// The state of the guards of a run, for the caller.
#include "handles.hpp"

#include <iterator>

using namespace tactus::capi;
using tactus::Guard;

namespace
{
constexpr const char* names[] = { "", "not_finite", "stale", "starved", "released", "halted", "speed", "impulse", "energy", "emergency" };
static_assert (std::size (names) == TACTUS_STOP_EMERGENCY + 1);
static_assert (static_cast<int> (Guard::Stop::emergency) == TACTUS_STOP_EMERGENCY && static_cast<int> (Guard::Stop::speed) == TACTUS_STOP_SPEED
               && static_cast<int> (Guard::Stop::not_finite) == TACTUS_STOP_NOT_FINITE);

tactus_stop asStop (Guard::Stop stop) noexcept { return static_cast<tactus_stop> (stop); }
double orNone (double limit) noexcept { return limit < tactus::GuardLimits::none ? limit : 0.0; }
}   // namespace

tactus_result tactus_run_guard (const tactus_run* r, const char* role, tactus_guard* to)
{
    if (r == nullptr || role == nullptr) return misuse ("a handle or pointer is NULL");
    const auto found = r->guards.find (role);
    if (! found) return misuse ("the run has no such role, or is not open");
    tactus_guard guard = TACTUS_GUARD;
    guard.stop = asStop (found->stop);
    guard.is_latched = found->is_latched != 0;
    guard.is_clipping = found->is_clipping != 0;
    guard.latest = asStop (found->latest.why);
    guard.value = found->latest.value;
    guard.limit = orNone (found->latest.limit);
    guard.window = orNone (found->latest.window);
    guard.stops = found->stops;
    return give (to, guard);
}

char* tactus_run_guard_text (const tactus_run* r, const char* role)
{
    if (r == nullptr || role == nullptr) return nullptr;
    return guarded<char*> (nullptr, nullptr, [&]() -> char* {
        const auto found = r->guards.find (role);
        return found ? copied (describe (found->latest)) : nullptr;
    });
}

const char* tactus_stop_name (tactus_stop stop)
{
    const auto at = static_cast<std::size_t> (stop);
    return at < std::size (names) ? names[at] : nullptr;
}
