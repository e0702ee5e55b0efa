// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/json.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/text_position.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// The user's devices: which device each role refers to, in all graphs, and which clock ticks a run. docs/sessions.md
/// describes the file. Entries that this version of Tactus does not know are kept.
class DeviceSession
{
public:
    static constexpr int version = 1;

    DeviceSession();

    /// A role, "timer" or "audio"; empty: the first device that can tick the run. [main thread, like all members]
    std::string clock() const;
    void setClock (std::string_view);

    /// The bound roles, in the order of the file.
    std::vector<std::string> roles() const;

    /// The description of a role's device, as in a graph's `devices`, plus "workspace"; null if the role is not bound.
    const Json* binding (std::string_view role) const;
    void bind (std::string_view role, Json description);
    void unbind (std::string_view role);

    /// Settings of sound cards, read by host/devices/audio; null if there are none.
    const Json* audio() const;
    void setAudio (Json);

    bool operator== (const DeviceSession&) const = default;

private:
    friend struct ReadSession readSession (std::string_view);
    friend std::string writeSession (const DeviceSession&);

    Json all;   // the object in the file; its known members have the right kind or are missing
};

struct ReadSession
{
    DeviceSession session;   ///< the content; empty if there are errors
    TextPositions positions;
    Messages messages;      ///< if there are errors, the session must not be used or overwritten; `where` is a JSON pointer
    bool damaged = false;   ///< true for a file that is not a session at all, such as a truncated one; false if the user can fix it
};

/// Reads a session. Accepts any text. Ids: session/format, session/version, session/kind, session/name, and file/… of
/// readJson.
ReadSession readSession (std::string_view text);

/// Writes a session as text. Equal sessions give equal text, and reading it back gives an equal session.
std::string writeSession (const DeviceSession&);

}   // namespace tactus::host
