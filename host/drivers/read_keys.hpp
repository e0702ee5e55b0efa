// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_device.h>
#include <tactus/text/json_text.hpp>
#include <tactus/text/object_reader.hpp>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

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

/// Reads a number from 0 to `most`, which is all of the text. False if it is none.
template <typename Integer>
bool readNumber (std::string_view text, Integer most, Integer& to)
{
    const auto read = std::from_chars (text.data(), text.data() + text.size(), to);
    return read.ec == std::errc() && read.ptr == text.data() + text.size() && to >= 0 && to <= most;
}

}   // namespace tactus::host
