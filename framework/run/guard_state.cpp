// SPDX-License-Identifier: MIT
// Apart from guard.cpp, because exported code contains that.
#include "guard.hpp"

#include <tactus/kit/state_archive.hpp>
#include <tactus/run/guard/shorten.hpp>

namespace tactus
{

void Guard::serialize (StateArchive& archive)
{
    if (is_falling) archive.refuse ("is just being tightened; wait until its limits have fallen");
    archive (drift, saved, behind, is_starved, is_unsettled, good_s, enabled, has_rearmed, withheld, at_stop, last, reason, latched, seen, seen_part,
             seen_channel, is_news, has_begun, event, count, change_count, judged_s, clipped_s, clips);
    archive (ticks, motion, mean_effort, speed, angular_speed, axis_velocity, impulse, angular_impulse, axis_impulse, energy, still, still_turn);
    const bool is_known = std::max ({ reason, latched, event.why }) <= Stop::emergency && std::max (seen_part, event.part) <= Event::Part::brake
                          && event.fault <= ReadingFault::moved;
    if (! is_known) archive.refuse ("has a stop that does not exist");
    if (! archive.restores()) return;
    shorten (last, limits);   // the limits of now hold, also on the way down
    shorten (at_stop, limits);
}

}   // namespace tactus
