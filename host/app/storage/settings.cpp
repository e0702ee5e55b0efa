// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings.hpp"

#include <host/app/text/filled.hpp>

#include <tactus/file/text_file.hpp>
#include <tactus/text/list_text.hpp>

#include <algorithm>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
constexpr double least_scale = 0.5, most_scale = 4.0;

/// Takes the members out of an object one by one, and notes the invalid ones.
class Reader
{
public:
    explicit Reader (Json& j) : json (j) {}

    template <typename F>
    void take (const char* key, bool (Json::*is)() const noexcept, F&& use)
    {
        const auto found = json.find (key);
        if (found == json.end()) return;
        if (! ((*found).*is)() || ! use (*found)) addToList (wrong, key);
        json.erase (key);
    }

    std::string wrong;

private:
    Json& json;
};

bool readPaths (const Json& list, std::vector<fs::path>& into)
{
    for (const auto& entry : list)
    {
        if (! entry.is_string()) return false;
        into.emplace_back (entry.get<std::string>());
    }
    return true;
}

Json pathsToJson (const std::vector<fs::path>& paths)
{
    auto list = Json::array();
    for (const auto& p : paths)
        list.push_back (p.string());
    return list;
}

template <typename T>
void putFirst (std::vector<T>& list, const T& value, std::size_t most)
{
    std::erase (list, value);
    list.insert (list.begin(), value);
    if (list.size() > most) list.resize (most);
}

fs::path fileIn (const fs::path& home) { return home / "settings.json"; }
}   // namespace

void Settings::noteRecent (const fs::path& file) { putFirst (recent, file, most_recent); }

void Settings::noteType (const std::string& type) { putFirst (recent_types, type, most_recent_types); }

bool Settings::isFavourite (const fs::path& file) const { return std::ranges::count (favourites, file) > 0; }

void Settings::toggleFavourite (const fs::path& file)
{
    if (std::erase (favourites, file) == 0) favourites.push_back (file);
}

ReadSettings readSettings (const std::string& text)
{
    ReadSettings read;
    auto& s = read.settings;
    auto json = Json::tryParse (text).value_or (Json());
    if (! json.is_object())
    {
        read.problem = TRANS ("not a JSON object").toStdString();
        return read;
    }
    Reader reader (json);
    const auto flag = [&] (const char* key, bool& into) {
        reader.take (key, &Json::is_boolean, [&] (const Json& v) {
            into = v.get<bool>();
            return true;
        });
    };
    reader.take ("theme", &Json::is_string, [&] (const Json& v) {
        s.light = v == "light";
        return v == "light" || v == "dark";
    });
    reader.take ("scale", &Json::is_number, [&] (const Json& v) {
        const auto scale = v.get<double>();
        const bool fits = scale == 0.0 || (scale >= least_scale && scale <= most_scale);
        if (fits) s.scale = scale;
        return fits;
    });
    reader.take ("language", &Json::is_string, [&] (const Json& v) {
        const auto& language = v.asString();
        const bool fits = language.empty() || isLanguage (language);
        if (fits) s.language = language;
        return fits;
    });
    flag ("welcomed", s.welcomed);
    flag ("toured", s.toured);
    flag ("scene", s.scene);
    reader.take ("film_s", &Json::is_number, [&] (const Json& v) {
        const auto seconds = v.get<double>();
        const bool fits = seconds >= 1.0 && seconds <= 120.0;
        if (fits) s.film_s = seconds;
        return fits;
    });
    flag ("fuse", s.fuse);
    reader.take ("panels", &Json::is_object, [&] (const Json& v) {
        for (const auto& [name, size] : v.items())
        {
            if (! size.is_number() || ! (size.get<double>() >= 0.0)) return false;
            if (size.get<double>() < 1.0) s.panels[name] = size.get<double>();   // older versions wrote pixels
        }
        return true;
    });
    reader.take ("recent", &Json::is_array, [&] (const Json& v) { return readPaths (v, s.recent); });
    reader.take ("favourites", &Json::is_array, [&] (const Json& v) { return readPaths (v, s.favourites); });
    reader.take ("folders", &Json::is_object, [&] (const Json& v) {
        for (const auto& [patterns, folder] : v.items())
        {
            if (! folder.is_string()) return false;
            s.folders[patterns] = folder.asString();
        }
        return true;
    });
    reader.take ("recordings", &Json::is_string, [&] (const Json& v) {
        s.recordings = v.asString();
        return true;
    });
    reader.take ("recent_types", &Json::is_array, [&] (const Json& v) {
        if (! std::ranges::all_of (v, &Json::is_string)) return false;
        s.recent_types = v.get<std::vector<std::string>>();
        if (s.recent_types.size() > Settings::most_recent_types) s.recent_types.resize (Settings::most_recent_types);
        return true;
    });
    if (s.recent.size() > Settings::most_recent) s.recent.resize (Settings::most_recent);
    if (! reader.wrong.empty()) read.problem = filled (TRANS ("invalid values for %1"), reader.wrong).toStdString();
    s.others = std::move (json);
    return read;
}

std::string writeSettings (const Settings& s)
{
    Json json {
        { "theme", s.light ? "light" : "dark" },
        { "scale", s.scale },
        { "language", s.language },
        { "welcomed", s.welcomed },
        { "toured", s.toured },
        { "scene", s.scene },
        { "film_s", s.film_s },
        { "fuse", s.fuse },
        { "panels", Json::object() },
        { "recent", pathsToJson (s.recent) },
        { "favourites", pathsToJson (s.favourites) },
        { "folders", Json::object() },
        { "recordings", s.recordings.string() },
        { "recent_types", s.recent_types }
    };
    for (const auto& [name, size] : s.panels)
        json["panels"][name] = size;
    for (const auto& [patterns, folder] : s.folders)
        json["folders"][patterns] = folder.string();
    for (const auto& [key, value] : s.others.items())
        if (! json.contains (key)) json[key] = value;
    return json.dump (2) + '\n';
}

ReadSettings loadSettings (const fs::path& home)
{
    const auto text = home.empty() ? std::nullopt : readTextFile (fileIn (home));
    if (! text) return {};
    auto read = readSettings (*text);
    if (read.problem.empty()) return read;
    auto aside = fileIn (home);
    aside += ".broken";
    std::error_code failed;
    fs::rename (fileIn (home), aside, failed);
    read.problem = filled (TRANS ("The settings file is damaged (%1). Unreadable settings were reset to their defaults."), read.problem).toStdString();
    if (! failed) read.problem += " " + filled (TRANS ("The damaged file is now %1."), aside.string()).toStdString();
    return read;
}

Result<> saveSettings (const Settings& s, const fs::path& home) { return writeTextFile (fileIn (home), writeSettings (s)); }

bool isLanguage (const std::string& code) noexcept
{
    const auto fits = [] (char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_'; };
    return ! code.empty() && code.size() <= 16 && std::ranges::all_of (code, fits);
}

double automaticScale (int height) noexcept
{
    if (height >= 2000) return 2.0;
    if (height >= 1700) return 1.5;
    if (height >= 1300) return 1.25;
    return 1.0;
}

}   // namespace tactus::host
