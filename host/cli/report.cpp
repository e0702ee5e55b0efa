// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <iostream>
#include <utility>

namespace tactus::host
{

namespace
{
std::string placeInFile (const Message& m)
{
    return m.line > 0 ? m.file + ":" + std::to_string (m.line) + ":" + std::to_string (m.column) : m.file + m.where;
}

std::string placeOf (const Message& m, const LoadedGraph& loaded, const std::string& file)
{
    const bool in_graph = m.where.empty() || m.where.starts_with ('/');
    if (file.empty() || (! m.file.empty() && m.file != file)) return m.file.empty() ? m.where : placeInFile (m);
    if (! in_graph) return m.where;   // `where` names a feed column or an option, not a part of the graph
    const auto at = m.line > 0 ? TextPosition { m.line, m.column } : loaded.positionOf (m.where);
    return file + ":" + std::to_string (at.line) + ":" + std::to_string (at.column);
}

/// The id at the end of a message. It may come from the answer of another program.
std::string idOf (const Message& m) { return " [" + printableName (m.id) + "]\n"; }

/// Shortens messages, because a file may contain a name of a megabyte. Long enough for the chain of a loop through many nodes.
std::string cut (std::string text)
{
    constexpr std::size_t longest = 10'000;
    if (text.size() <= longest) return text;
    auto end = longest;
    while (end > 0 && (static_cast<unsigned char> (text[end]) & 0xc0) == 0x80)   // within a character
        --end;
    return text.substr (0, end) + "…";
}
}   // namespace

std::string inOneLine (std::string text)
{
    text = cut (std::move (text));
    std::ranges::replace (text, '\n', ' ');
    return printable (text);
}

int report (const Messages& messages, const LoadedGraph& loaded, const std::string& file)
{
    int errors = 0;
    std::size_t count = 0;
    for (const auto& m : messages)
    {
        const bool error = m.severity == Message::Severity::error;
        errors += error;
        if (++count > most_messages) continue;
        const auto place = inOneLine (placeOf (m, loaded, file));
        std::cerr << place << (place.empty() ? "" : ": ") << (error ? "error: " : "warning: ") << inOneLine (m.text);
        std::cerr << "\n    " << printable (cut (m.remedy)) << idOf (m);
    }
    if (count > most_messages) std::cerr << inOneLine (file) << ": problems not listed: " << count - most_messages << "\n    fix the listed ones first\n";
    return errors;
}

int report (const Messages& messages) { return report (messages, {}, ""); }

void warn (const std::string& file, const Message& m)
{
    std::cerr << inOneLine (file) << ": warning: " << inOneLine (m.text);
    if (! m.remedy.empty()) std::cerr << "\n    " << printable (cut (m.remedy));
    std::cerr << idOf (m);
}

void warnOfFiles (const Messages& messages)
{
    for (const auto& m : messages)
        warn (placeInFile (m), m);
}

void fail (const Message& e)
{
    std::cerr << inOneLine (e.where) << (e.where.empty() ? "" : ": ") << "error: " << inOneLine (e.text);
    std::cerr << "\n    " << printable (cut (e.remedy)) << idOf (e);
    throw Stop {};
}

void fail (const std::string& id, const std::string& what, const std::string& remedy) { fail (Message::error (id, "", what, remedy)); }

}   // namespace tactus::host
