// SPDX-License-Identifier: MIT
#include "system_facts.hpp"

#include <tactus/text/quote.hpp>

#include <fstream>
#include <thread>

#if ! defined(_WIN32)
#include <sys/resource.h>
#include <sys/utsname.h>
#endif

namespace tactus::host
{

namespace
{
#if defined(__linux__)
/// The first line of a file of the system; empty if it is not there.
std::string lineOf (const char* file)
{
    std::string line;
    std::ifstream in (file);
    std::getline (in, line);
    return printable (line.substr (0, 100));
}
#endif

#if ! defined(_WIN32)
std::string limitOf (decltype (RLIMIT_NOFILE) which, rlim_t unit, const char* name)
{
    rlimit limit {};
    if (::getrlimit (which, &limit) != 0) return {};
    return limit.rlim_cur == RLIM_INFINITY ? "no limit" : "limit " + std::to_string (limit.rlim_cur / unit) + name;
}
#endif
}   // namespace

std::vector<std::pair<std::string, std::string>> systemFacts()
{
    std::vector<std::pair<std::string, std::string>> facts;
    const auto add = [&] (const char* name, std::string text) {
        if (! text.empty()) facts.emplace_back (name, std::move (text));
    };
#if ! defined(_WIN32)
    utsname about {};
    if (::uname (&about) == 0) add ("kernel", printable (std::string (about.sysname) + " " + about.release + " " + about.machine));   // without nodename
#endif
    add ("processors", std::to_string (std::thread::hardware_concurrency()));
#if defined(__linux__)
    add ("real-time kernel", lineOf ("/sys/kernel/realtime") == "1" ? "yes" : "no");
    add ("time for real-time threads", lineOf ("/proc/sys/kernel/sched_rt_runtime_us") + " of " + lineOf ("/proc/sys/kernel/sched_rt_period_us") + " us");
    add ("governor of the clock frequency", lineOf ("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor"));
    add ("real-time priority", limitOf (RLIMIT_RTPRIO, 1, ""));
#endif
#if ! defined(_WIN32)
    add ("locked memory", limitOf (RLIMIT_MEMLOCK, 1024, " KiB"));
    add ("open files", limitOf (RLIMIT_NOFILE, 1, ""));
#endif
    return facts;
}

}   // namespace tactus::host
