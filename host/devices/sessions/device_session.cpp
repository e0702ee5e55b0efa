// SPDX-License-Identifier: MIT
#include "device_session.hpp"

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <utility>

namespace tactus::host
{

namespace
{
constexpr std::string_view format = "tactus-session";

/// A member of an object; null if there is none.
const Json* at (const Json& object, std::string_view key)
{
    const auto found = object.find (key);
    return found == object.end() ? nullptr : &*found;
}
}   // namespace

DeviceSession::DeviceSession() : all { { "format", format }, { "version", version } } {}

std::string DeviceSession::clock() const
{
    const auto* told = at (all, "clock");
    return told != nullptr ? told->get<std::string>() : std::string();
}

void DeviceSession::setClock (std::string_view name)
{
    if (name.empty())
        all.erase ("clock");
    else
        all["clock"] = name;
}

std::vector<std::string> DeviceSession::roles() const
{
    std::vector<std::string> names;
    if (const auto* bound = at (all, "roles"))
        for (const auto& [name, description] : bound->items())
            names.push_back (name);
    return names;
}

const Json* DeviceSession::binding (std::string_view role) const
{
    const auto* bound = at (all, "roles");
    return bound != nullptr ? at (*bound, role) : nullptr;
}

void DeviceSession::bind (std::string_view role, Json description) { all["roles"][std::string (role)] = std::move (description); }

void DeviceSession::unbind (std::string_view role)
{
    const auto bound = all.find ("roles");
    if (bound != all.end()) bound->erase (std::string (role));
}

const Json* DeviceSession::audio() const { return at (all, "audio"); }

void DeviceSession::setAudio (Json audio)
{
    if (audio.is_null())
        all.erase ("audio");
    else
        all["audio"] = std::move (audio);
}

ReadSession readSession (std::string_view text)
{
    ReadSession read;
    auto parsed = readJson (text, Budgets {}.values);   // a low --limits must not make the user's session look damaged
    auto& json = parsed.root;
    auto& messages = parsed.messages;
    const auto refuse = [&] (std::string id, const std::string& where, std::string what, std::string remedy) {
        messages.push_back (Message::error (std::move (id), where, std::move (what), std::move (remedy)));
    };

    read.damaged = hasErrors (messages);
    if (! read.damaged && (! json.is_object() || json.value ("format", Json()) != format))
    {
        refuse ("session/format", "", "this is not a session file", R"(a session file begins with {"format": "tactus-session", "version": 1)");
        read.damaged = true;
    }
    else if (! read.damaged)
    {
        const auto* version = at (json, "version");
        if (version == nullptr || ! version->is_number_integer() || version->get<std::int64_t>() < 1)
            refuse ("session/version", "/version", "the version is missing, or is not a whole number of at least 1",
                    "write \"version\": " + std::to_string (DeviceSession::version));
        else if (version->get<std::int64_t>() > DeviceSession::version)
            refuse ("session/version", "/version",
                    "this session has version " + version->dump() + ", but this Tactus reads only version " + std::to_string (DeviceSession::version),
                    "use a newer Tactus; nothing in the file was changed");

        if (const auto* clock = at (json, "clock"); clock != nullptr && (! clock->is_string() || ! graph::isId (clock->asString())))
            refuse ("session/kind", "/clock", "the clock must be the name of a role, \"timer\" or \"audio\"", "write such a name, or leave the clock out");
        if (const auto* audio = at (json, "audio"); audio != nullptr && ! audio->is_object())
            refuse ("session/kind", "/audio", "the audio settings must be an object", R"(write "audio": {}, or leave the audio settings out)");
        if (const auto* roles = at (json, "roles"); roles != nullptr && ! roles->is_object())
            refuse ("session/kind", "/roles", "the roles must be an object", R"(write "roles": {"stylus": {"driver": "hid", "profile": "tactus_board"}})");
        else if (roles != nullptr)
            for (const auto& [name, description] : roles->items())
            {
                const auto where = "/roles/" + pointerPart (name);
                if (! graph::isId (name))
                    refuse ("session/name", where, quote (name) + " is not a valid role name", "use lower-case letters, digits and _, starting with a letter");
                if (! description.is_object())
                    refuse ("session/kind", where, "the binding of a role must be an object",
                            R"(write {"driver": "hid", "profile": "tactus_board"}, or leave the role out)");
            }
    }

    for (auto& m : messages)
        if (m.line == 0)
        {
            const auto position = positionOf (parsed.positions, m.where);
            m.line = position.line;
            m.column = position.column;
        }
    if (! hasErrors (messages)) read.session.all = std::move (json);
    read.messages = std::move (messages);
    read.positions = std::move (parsed.positions);
    return read;
}

std::string writeSession (const DeviceSession& s) { return s.all.dump (2) + '\n'; }

}   // namespace tactus::host
