// SPDX-License-Identifier: MIT
#include "check_find.hpp"

#include <tactus/examine/stage.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>
#include <vector>

namespace tactus::check_plugin
{

namespace
{
constexpr std::size_t most_devices = 1000, longest_text = 1000;
constexpr std::uint32_t known_states = TACTUS_DEVICE_IN_USE | TACTUS_DEVICE_UNSEEN;

/// The devices of one call of `find`: ports and names.
struct Found
{
    std::vector<std::pair<std::string, std::string>> all;
    std::string fault;
    std::atomic<bool> is_over = false, came_late = false;
};

/// The fault of a text; empty if there is none. It is read only as far as a text may go, because it may have no end.
std::string faultOfText (const char* what, const char* text)
{
    const std::string name = what;
    if (text == nullptr) return name + " is NULL";
    if (::strnlen (text, longest_text + 1) > longest_text) return name + " has no end within " + std::to_string (longest_text) + " bytes";
    if (printable (text) != text) return name + " " + quote (text) + " has characters that cannot be printed";
    return {};
}

std::string faultOfDevice (const tactus_device_found* found, const Found& before)
{
    if (found == nullptr) return "it is NULL";
    if (found->size < sizeof *found) return "its size is " + std::to_string (found->size);
    if (auto fault = faultOfText ("its port", found->port); ! fault.empty()) return fault;
    if (auto fault = faultOfText ("its name", found->name); ! fault.empty()) return fault;
    if (found->name[0] == 0) return "it has no name";
    if ((found->state & ~known_states) != 0) return "its state is " + std::to_string (found->state);
    const bool is_known = std::ranges::count (before.all, found->port, &std::pair<std::string, std::string>::first) > 0;
    if (is_known) return "its port " + quote (found->port) + " came before";
    return {};
}

void add (void* context, const tactus_device_found* found)
{
    auto& of = *static_cast<Found*> (context);
    if (of.is_over) of.came_late = true;
    if (of.is_over || ! of.fault.empty()) return;
    const auto number = "device " + std::to_string (of.all.size());
    if (auto fault = faultOfDevice (found, of); ! fault.empty())
        of.fault = number + ": " + fault;
    else if (of.all.size() == most_devices)
        of.fault = "it finds more than " + std::to_string (most_devices) + " devices";
    else
        of.all.emplace_back (found->port, found->name);
}
}   // namespace

std::string faultOfFind (const host::DeviceDriver& driver)
{
    using namespace std::chrono_literals;
    const auto& functions = driver.functions();
    static Found lists[2];   // a driver that calls too late must not write into freed memory
    for (auto& list : lists)
    {
        const tactus_device_finder finder { sizeof finder, &list, add };
        host::DriverReport why;
        examine::Stage::enter ("find");
        const int answer = functions.find (&finder, why.to());
        examine::Stage::enter ("between two calls");
        list.is_over = true;
        if (! list.fault.empty()) return list.fault;
        if (answer != TACTUS_DEVICE_OK && answer != TACTUS_DEVICE_FAILED) return "`find` returns " + std::to_string (answer);
        if (answer == TACTUS_DEVICE_FAILED) return why.text ("").empty() ? "`find` fails and does not say why" : "";   // it cannot look here, and says so
    }
    std::this_thread::sleep_for (50ms);
    if (lists[0].came_late || lists[1].came_late) return "it adds a device after `find` has returned";
    if (lists[0].all != lists[1].all) return "the second call of `find` finds other devices than the first one";
    for (const auto& [port, name] : lists[0].all)
        if (const auto wrong = driver.check (Json { { "driver", driver.name() }, { "port", port } }); ! port.empty() && hasErrors (wrong))
            return "`check` refuses the port " + quote (port) + " that `find` has found";
    return {};
}

}   // namespace tactus::check_plugin
