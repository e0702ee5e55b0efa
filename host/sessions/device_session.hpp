// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/file/text_position.hpp>
#include <framework/json.hpp>
#include <framework/message.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// What devices somebody has on the desk: which one a role of a graph means, whatever the graph, and what ticks a run.
/// docs/sessions.md has the file. What this version of Tactus does not know is kept as it is.
class DeviceSession
{
public:
    static constexpr int version = 1;

    DeviceSession();

    /// A role, "timer" or "audio"; empty: the first device that can. [main thread, as all of it]
    std::string clock() const;
    void setClock (std::string_view);

    /// The roles that are bound, in the order of the file.
    std::vector<std::string> roles() const;

    /// The description of a role's device, as in a graph's `devices`, beside "workspace"; null if the role is not bound.
    const Json* binding (std::string_view role) const;
    void bind (std::string_view role, Json description);
    void unbind (std::string_view role);

    /// How sound cards are used: for host/audio to read; null if nothing is said.
    const Json* audio() const;
    void setAudio (Json);

    bool operator== (const DeviceSession&) const = default;

private:
    friend struct ReadSession readSession (std::string_view);
    friend std::string writeSession (const DeviceSession&);

    Json all;   // an object as of the file, with these members of the right kinds, or without them
};

struct ReadSession
{
    DeviceSession session;   ///< what could be read
    TextPositions positions;
    Messages messages;      ///< with errors it is to be used for nothing, and not written over; `where` is a JSON pointer
    bool damaged = false;   ///< no session at all, as a file that was cut off; else it is a person's to mend
};

/// Reads a session. Takes any text. Ids: session/format, session/version, session/kind, session/name, and file/… of readJson.
ReadSession readSession (std::string_view text);

/// The same text for the same session; what is read from it is the same session.
std::string writeSession (const DeviceSession&);

}   // namespace tactus::host
