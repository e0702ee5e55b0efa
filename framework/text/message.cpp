// SPDX-License-Identifier: MIT
#include "message.hpp"

#include <algorithm>
#include <utility>

namespace tactus
{

Message::Message() = default;
Message::Message (const Message&) = default;
Message::Message (Message&&) noexcept = default;
Message& Message::operator= (const Message&) = default;
Message& Message::operator= (Message&&) noexcept = default;
Message::~Message() = default;

Message Message::error (std::string id, std::string where, std::string text, std::string remedy)
{
    Message m;
    m.id = std::move (id);
    m.where = std::move (where);
    m.text = std::move (text);
    m.remedy = std::move (remedy);
    return m;
}

Message Message::warning (std::string id, std::string where, std::string text, std::string remedy)
{
    auto m = error (std::move (id), std::move (where), std::move (text), std::move (remedy));
    m.severity = Severity::warning;
    return m;
}

std::string sentence (const Message& m) { return (m.where.empty() ? "" : m.where + ": ") + m.text + (m.remedy.empty() ? "" : "; " + m.remedy); }

std::string describe (const Message& m) { return m.where + ": " + m.text + "; " + m.remedy + " [" + m.id + "]"; }

bool hasErrors (const Messages& messages)
{
    return std::ranges::any_of (messages, [] (const Message& m) { return m.severity == Message::Severity::error; });
}

}   // namespace tactus
