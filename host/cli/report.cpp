// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <iostream>

namespace tactus::host
{

namespace
{
std::string placeOf (const Message& m, const LoadedGraph& loaded, const std::string& file)
{
    const bool in_graph = m.where.empty() || m.where.starts_with ('/');
    if (! m.file.empty() && m.file != file)
        return m.line > 0 ? m.file + ":" + std::to_string (m.line) + ":" + std::to_string (m.column) : m.file + m.where;
    if (! in_graph) return m.where;   // `where` names a feed column or an option, not a part of the graph
    const auto at = m.line > 0 ? TextPosition { m.line, m.column } : loaded.positionOf (m.where);
    return file + ":" + std::to_string (at.line) + ":" + std::to_string (at.column);
}

/// Makes the location of a message printable, on one line.
std::string inOneLine (std::string text)
{
    std::ranges::replace (text, '\n', ' ');
    return printable (text);
}
}   // namespace

int report (const Messages& messages, const LoadedGraph& loaded, const std::string& file)
{
    int errors = 0;
    std::size_t count = 0;
    for (const auto& m : messages)
    {
        const bool error = m.severity == Message::Severity::error;
        errors += error;
        if (++count > most_messages) continue;
        std::cerr << inOneLine (placeOf (m, loaded, file)) << ": " << (error ? "error: " : "warning: ") << printable (m.text);
        std::cerr << "\n    " << printable (m.remedy) << " [" << m.id << "]\n";
    }
    if (count > most_messages) std::cerr << inOneLine (file) << ": problems not listed: " << count - most_messages << "\n    fix the listed ones first\n";
    return errors;
}

void warn (const std::string& file, const Message& m) { std::cerr << inOneLine (file) << ": warning: " << printable (m.text) << " [" << m.id << "]\n"; }

void fail (const Message& e)
{
    std::cerr << inOneLine (e.where) << (e.where.empty() ? "" : ": ") << "error: " << printable (e.text);
    std::cerr << "\n    " << printable (e.remedy) << " [" << e.id << "]\n";
    throw Stop {};
}

void fail (const std::string& id, const std::string& what, const std::string& remedy) { fail (Message::error (id, "", what, remedy)); }

}   // namespace tactus::host
