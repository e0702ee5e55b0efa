// SPDX-License-Identifier: MIT
#include "stamp_watch.hpp"

#include <tactus/kit/fine.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr double drift = 1e-3;
constexpr std::uint64_t most_lost = 1'000'000;   // a number that jumps must not spoil what is counted
}   // namespace

double StampWatch::lagOf (double time_s, double now_s) noexcept
{
    const double difference = now_s - time_s;
    offset = has_clock ? std::min (offset + drift * (now_s - arrived), difference) : difference;
    has_clock = true;
    return difference - offset;
}

StampWatch::Assessment StampWatch::operator() (const tactus_device_stamp& stamp, double now_s) noexcept
{
    Assessment v;
    const bool has_number = stamp.number != 0, has_time = stamp.time_s != 0.0;
    const bool lacks_one = (! has_number && (promised & TACTUS_DEVICE_NUMBERS) != 0) || (! has_time && (promised & TACTUS_DEVICE_TIMES) != 0);
    if (lacks_one || ! isFinite (stamp.time_s)) return { .fault = ReadingFault::malformed };
    if (has_one && has_number && stamp.number == number) return { .is_new = false, .fault = ReadingFault::repeated };
    if (has_one && has_time && stamp.time_s == time) return { .is_new = false, .fault = ReadingFault::clock_stopped };

    v.has_gone_back = has_one && ((has_number && stamp.number < number) || (has_time && stamp.time_s < time));
    if (v.has_gone_back)
    {
        record.restart();
        restarted = true;
        has_clock = false;
    }
    else
    {
        if (has_one && has_number && number != 0)
            v.lost = std::min (stamp.number - number - 1, most_lost);
        else if (has_one && ! has_number && rate > 0.0)
            v.lost = hid::ReportRecord::missingAfter (now_s - arrived, rate);
        record.arrived (v.lost);
        restarted = restarted && ! record.isTrusted();
    }
    if (has_time) v.lag_s = lagOf (stamp.time_s, now_s);
    number = stamp.number;
    time = stamp.time_s;
    arrived = now_s;
    has_one = true;
    if (restarted)
        v.fault = ReadingFault::restarted;
    else if (! record.isTrusted())
        v.fault = ReadingFault::lost;
    return v;
}

}   // namespace tactus::host
