// SPDX-License-Identifier: MIT
#include "profile_library.hpp"
#include <host/base/platform/device_file.hpp>
#include <host/base/platform/preset_folder.hpp>
#include <host/devices/hid/profile_difference.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/ownership.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

namespace tactus::host::hid
{
namespace fs = std::filesystem;

namespace
{
/// Also false for a folder that the user has no permission to read.
bool isFolder (const fs::path& path)
{
    std::error_code forbidden;
    return fs::is_directory (path, forbidden);
}

/// True if one device can fit both rules. Only the ids count: the interfaces, usages, buses and names of one device lead to the same
/// motors, and not every platform provides them.
bool canFitOneDevice (const MatchRule& a, const MatchRule& b)
{
    const auto share = [] (const auto& x, const auto& y) {
        return x.empty() || y.empty() || std::ranges::any_of (x, [&] (auto id) { return std::ranges::count (y, id) > 0; });
    };
    return share (a.vid, b.vid) && share (a.pid, b.pid);
}

bool canFitOneDevice (const Profile& a, const Profile& b)
{
    return std::ranges::any_of (a.match, [&] (const MatchRule& x) {
        return std::ranges::any_of (b.match, [&] (const MatchRule& y) { return canFitOneDevice (x, y); });
    });
}

/// An error if the user's profile differs from the shipped one for a device, whose limits then mean nothing. If several shipped profiles fit
/// that device, one of them must be the same, or be replaced.
std::optional<Message> competition (const std::vector<std::shared_ptr<const Profile>>& shipped, const Profile& own)
{
    for (const auto& one : shipped)
    {
        const auto allows = [&] (const auto& other) {
            return canFitOneDevice (own, *other) && canFitOneDevice (*one, *other) && (other->id == own.replaces || differenceOf (own, *other).empty());
        };
        if (! canFitOneDevice (own, *one) || std::ranges::any_of (shipped, allows)) continue;
        return Message::error ("profile/competes", "/match",
                               "the profile fits the same devices as the shipped " + quote (one->id) + " but differs from it in " + differenceOf (own, *one)
                                   + ", so it is not used",
                               "change only names, texts and limits; or fit other devices; or, to use it instead of the shipped one and its limits, add "
                               "\"replaces\": \""
                                   + one->id + '"');
    }
    return {};
}

/// The user's profile with the limits of the shipped ones that can fit the same device, except the one that it replaces. Appends
/// their ids to `others`.
std::shared_ptr<const Profile> limitedBy (const std::vector<std::shared_ptr<const Profile>>& shipped, const std::shared_ptr<const Profile>& own, std::string& others)
{
    auto limited = *own;
    for (const auto& other : shipped)
    {
        if (other->id == own->replaces || ! canFitOneDevice (*own, *other)) continue;
        limited.limits = tightest (limited.limits, other->limits);
        addToList (others, quote (other->id));
    }
    return others.empty() ? own : std::make_shared<const Profile> (std::move (limited));
}
}   // namespace

fs::path profileFolder()
{
    return shipped ({ "profiles", "../share/tactus/profiles", "../../../host/devices/profiles" });
}

fs::path ownProfileFolder()
{
    if (const char* given = std::getenv ("TACTUS_PROFILES"); given != nullptr && *given != 0) return given;
    // A relative path would be in the folder of whatever graph is played.
    const auto within = [] (const char* variable, const char* folder) {
        const char* value = std::getenv (variable);
        const fs::path path (value != nullptr ? value : "");
        return path.is_absolute() ? path / folder : fs::path();
    };
    const auto configured = within ("XDG_CONFIG_HOME", "tactus/profiles");
    return configured.empty() ? within ("HOME", ".config/tactus/profiles") : configured;
}

LoadedProfiles joined (LoadedProfiles own, LoadedProfiles shipped)
{
    LoadedProfiles all { {}, std::move (shipped.messages) };
    std::vector<std::shared_ptr<const Profile>> used;
    std::vector<std::string> replaced;
    for (auto& profile : own.profiles)
    {
        const auto note = [&] (Message m) {
            m.file = profile->file;
            all.messages.push_back (std::move (m));
        };
        const auto isShipped = [&] (const std::string& id) { return std::ranges::count (shipped.profiles, id, &Profile::id) > 0; };
        if (isShipped (profile->id) && profile->replaces != profile->id)
        {
            note (Message::error ("profile/shadows", "/id", "the profile has the id of a shipped one, " + quote (profile->id) + ", so it is not used",
                                  "give it another id; or, to use it instead of the shipped one and its limits, add \"replaces\": \"" + profile->id + '"'));
            continue;
        }
        if (auto error = competition (shipped.profiles, *profile))
        {
            note (std::move (*error));
            continue;
        }
        if (isShipped (profile->replaces))
        {
            const auto shipped_one = "the shipped profile " + quote (profile->replaces);
            note (Message::warning ("profile/replaces", "/replaces", "the profile replaces " + shipped_one + " and its limits",
                                    "remove this file to use the shipped profile"));
            replaced.push_back (profile->replaces);
        }
        std::string others;
        profile = limitedBy (shipped.profiles, profile, others);
        if (! others.empty())
            note (Message::warning ("profile/competes", "/match",
                                    "the profile fits the same devices as the shipped " + others + ", so it keeps to those limits too",
                                    "fit other devices; or, to use it instead of one shipped profile and its limits, add \"replaces\" with the "
                                    "id of that one"));
        used.push_back (std::move (profile));
    }
    std::ranges::copy_if (shipped.profiles, std::back_inserter (all.profiles),
                          [&] (const auto& profile) { return std::ranges::count (replaced, profile->id) == 0; });
    std::ranges::move (used, std::back_inserter (all.profiles));
    std::ranges::move (own.messages, std::back_inserter (all.messages));
    return all;
}

LoadedProfiles loadOwnProfiles (const fs::path& folder)
{
    auto who = whoElseCanChange (folder);
    if (who.empty()) return loadProfiles (folder, true);
    auto m = Message::error ("profile/foreign", "", std::move (who) + ", so the profiles there are not used",
                             "change its owner or its permissions (chown, chmod go-w), or set TACTUS_PROFILES to a folder of your own");
    m.file = folder.string();
    return { {}, { std::move (m) } };
}

LoadedProfiles loadProfileLibrary()
{
    LoadedProfiles own, shipped;
    if (const auto folder = ownProfileFolder(); ! folder.empty() && isFolder (folder))
        own = loadOwnProfiles (folder);
    else if (const char* given = std::getenv ("TACTUS_PROFILES"); given != nullptr && *given != 0)
    {
        auto& m = own.messages.emplace_back (
            Message::warning ("profile/unreadable", "", "there is no such folder, although TACTUS_PROFILES names it", "create it, or name another one"));
        m.file = folder.string();
    }
    if (const auto folder = profileFolder(); ! folder.empty()) shipped = loadProfiles (folder);
    return joined (std::move (own), std::move (shipped));
}

}   // namespace tactus::host::hid
