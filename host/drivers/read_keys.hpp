// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_device.h>
#include <tactus/text/json_text.hpp>
#include <tactus/text/object_reader.hpp>

#include <algorithm>
#include <string>

namespace tactus::host
{

/// Reads the port of a description and, by `read`, its other keys. Returns what is wrong; empty: nothing is.
template <typename Read>
std::string readKeys (const tactus_device_description& given, std::string& port, Read&& read)
{
    Messages messages;
    const auto json = readJson (given.json != nullptr && given.json[0] != 0 ? given.json : "{}").root;
    ObjectReader in (json, "", messages);
    in.ignore ("port");
    read (in);
    in.finish();
    port = given.port != nullptr ? given.port : "";
    const auto wrong = std::ranges::find (messages, Message::Severity::error, &Message::severity);
    return wrong != messages.end() ? wrong->where + ": " + wrong->text + "; " + wrong->remedy : std::string();
}

}   // namespace tactus::host
