// SPDX-License-Identifier: MIT
#include "messages.hpp"

#include <tactus/text/json.hpp>

namespace tactus::python
{

void report (const Messages& messages)
{
    if (messages.empty()) return;
    py::list all;
    for (const auto& m : messages)
        all.append (py::make_tuple (m.severity == Message::Severity::error, m.id, m.where, m.text, m.remedy, m.file, m.line, m.column));
    py::module_::import ("tactus._messages").attr ("report") (all);
}

void fail (Message m)
{
    report ({ std::move (m) });
    throw std::logic_error ("an error was reported, but Python did not raise it");
}

Json jsonOf (const std::string& text)
{
    if (auto value = Json::tryParse (text)) return std::move (*value);
    fail (Message::error ("api/value", "", "the value " + text + " is not JSON", "give a number, text, a list or a dict of these"));
}

}   // namespace tactus::python
