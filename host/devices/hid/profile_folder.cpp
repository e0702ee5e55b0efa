// SPDX-License-Identifier: MIT
// The folders that profiles are read from.
#include "profile_reader.hpp"

#include <tactus/file/text_file.hpp>
#include <tactus/text/ownership.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

namespace tactus::host::hid
{

LoadedProfiles loadProfiles (const std::filesystem::path& folder, bool are_own)
{
    LoadedProfiles loaded;
    const auto complain = [&] (const std::filesystem::path& file, Message message) {
        message.file = file.string();
        loaded.messages.push_back (std::move (message));
    };

    std::vector<std::filesystem::path> files;
    std::error_code failed;
    for (std::filesystem::directory_iterator it (folder, failed), end; ! failed && it != end; it.increment (failed))
        if (it->path().extension() == ".json" && ! it->path().stem().string().ends_with (".schema")) files.push_back (it->path());
    if (failed)
        complain (folder, Message::error ("profile/unreadable", "", "the folder of device profiles cannot be read: " + failed.message(),
                                          "create the folder, or name another one"));
    std::ranges::sort (files);

    for (const auto& file : files)
    {
        if (auto who = are_own ? whoElseCanChange (file) : std::string(); ! who.empty())
        {
            complain (file, Message::error ("profile/foreign", "", std::move (who) + ", so the profile is not used",
                                            "change its owner or its permissions (chown, chmod go-w)"));
            continue;
        }
        const auto text = readTextFile (file);
        if (! text || text->empty())
        {
            complain (file,
                      Message::error ("profile/unreadable", "", "the profile cannot be read", "check that the file exists, is not empty, and is readable"));
            continue;
        }

        auto one = readProfileText (*text);
        for (auto& m : one.messages)
            m.file = file.string();
        loaded.messages.insert (loaded.messages.end(), std::make_move_iterator (one.messages.begin()), std::make_move_iterator (one.messages.end()));
        if (! one.profile) continue;

        const auto same = [&] (const auto& other) { return other->id == one.profile->id; };
        if (const auto other = std::ranges::find_if (loaded.profiles, same); other != loaded.profiles.end())
        {
            complain (file, Message::error ("profile/duplicate", "/id", quote (one.profile->id) + " is already the id of " + (*other)->file,
                                            "give the profile another id"));
            continue;
        }
        auto profile = *one.profile;
        profile.file = file.string();
        loaded.profiles.push_back (std::make_shared<const Profile> (std::move (profile)));
    }
    return loaded;
}

std::shared_ptr<const Profile> profileNamed (const LoadedProfiles& all, std::string_view id)
{
    const auto at = std::ranges::find_if (all.profiles, [&] (const auto& p) { return p->id == id; });
    return at == all.profiles.end() ? nullptr : *at;
}

}   // namespace tactus::host::hid
