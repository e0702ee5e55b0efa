// SPDX-License-Identifier: MIT
#include "match.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace tactus::host::hid
{
namespace
{
bool containsInAnyCase (std::string_view text, std::string_view part) noexcept
{
    const auto same = [] (char a, char b) { return std::tolower (static_cast<unsigned char> (a)) == std::tolower (static_cast<unsigned char> (b)); };
    return std::search (text.begin(), text.end(), part.begin(), part.end(), same) != text.end() || part.empty();
}

/// The score of one entry of a rule: 0 if the entry is absent or the platform does not provide the data, its weight if it
/// fits, and far below 0 if it does not.
int worth (bool said_and_known, bool fits, int weight) noexcept
{
    if (! said_and_known) return 0;
    return fits ? weight : -1000;
}

int fit (const MatchRule& rule, const DeviceInfo& device) noexcept
{
    const auto among = [] (const std::vector<std::uint16_t>& list, std::uint16_t id) { return std::ranges::find (list, id) != list.end(); };

    return worth (! rule.vid.empty(), among (rule.vid, device.vid), 16)
           + worth (! rule.pid.empty(), among (rule.pid, device.pid), 32)
           + worth (rule.usage_page && device.usage_page != 0, rule.usage_page == device.usage_page, 4)
           + worth (rule.usage && device.usage_page != 0, rule.usage == device.usage, 2)
           + worth (rule.interface_number && device.interface_number >= 0, rule.interface_number == device.interface_number, 8)
           + worth (rule.bus && device.bus != Bus::unknown, rule.bus == device.bus, 1)
           + worth (! rule.product.empty(), containsInAnyCase (device.product, rule.product), 64);
}
}   // namespace

int fit (const Profile& profile, const DeviceInfo& device) noexcept
{
    int best = 0;
    for (const auto& rule : profile.match)
        best = std::max (best, fit (rule, device));
    return best;
}

std::vector<std::shared_ptr<const Profile>> matching (std::span<const std::shared_ptr<const Profile>> profiles, const DeviceInfo& device)
{
    std::vector<std::shared_ptr<const Profile>> found;
    for (const auto& profile : profiles)
        if (fit (*profile, device) > 0) found.push_back (profile);

    std::ranges::sort (found, [&] (const auto& a, const auto& b) {
        const int fit_a = fit (*a, device), fit_b = fit (*b, device);
        return fit_a != fit_b ? fit_a > fit_b : a->id < b->id;
    });
    return found;
}

}   // namespace tactus::host::hid
