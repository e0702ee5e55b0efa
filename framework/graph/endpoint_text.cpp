// SPDX-License-Identifier: MIT
#include "endpoint_text.hpp"
#include "wire_text.hpp"

#include <tactus/kit/at.hpp>
#include <tactus/text/quote.hpp>

#include <array>
#include <charconv>
#include <optional>

namespace tactus::graph
{
namespace
{
constexpr bool startsId (char c) noexcept { return c >= 'a' && c <= 'z'; }

/// By character: true for those that an id may contain. A table, because a large graph has many ids.
constexpr auto in_ids = [] {
    std::array<bool, 256> all {};
    for (const char c : std::string_view ("abcdefghijklmnopqrstuvwxyz0123456789_"))
        all[static_cast<unsigned char> (c)] = true;
    return all;
}();
constexpr bool continuesId (char c) noexcept { return in_ids[static_cast<unsigned char> (c)]; }

std::string_view trimmed (std::string_view text) noexcept
{
    const auto isSpace = [] (char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
    while (! text.empty() && isSpace (text.front()))
        text.remove_prefix (1);
    while (! text.empty() && isSpace (text.back()))
        text.remove_suffix (1);
    return text;
}

/// Reads a string from the front.
struct Reader
{
    std::string_view text;

    bool take (std::string_view expected)
    {
        if (! text.starts_with (expected)) return false;
        text.remove_prefix (expected.size());
        return true;
    }

    bool take (char expected)
    {
        if (text.empty() || text.front() != expected) return false;
        text.remove_prefix (1);
        return true;
    }

    std::string_view id()
    {
        std::size_t size = 0;
        if (! text.empty() && startsId (text.front()))
            while (size < text.size() && continuesId (text[size]))
                ++size;
        const auto read = text.substr (0, size);
        text.remove_prefix (size);
        return read;
    }

    /// A whole number of at least 0, as written in brackets.
    std::optional<int> number()
    {
        int n = 0;
        if (text.starts_with ('-')) return std::nullopt;
        const auto [end, error] = std::from_chars (text.data(), text.data() + text.size(), n);
        if (error != std::errc {}) return std::nullopt;
        text.remove_prefix (at (end - text.data()));
        return n;
    }

    /// The text that follows, for a message.
    std::string next() const { return text.empty() ? "the end" : quote (text); }
};

constexpr auto id_rule = "ids consist of lower-case letters, digits and _, and begin with a letter";

/// Reads "[3]" or "[*]" after its opening bracket and appends it in its normal form. Returns false if there is neither.
bool readInstance (Reader& in, std::string& path)
{
    if (in.take ("*]"))
    {
        path += "[*]";
        return true;
    }
    const auto n = in.number();
    if (! n || ! in.take (']')) return false;
    path += '[' + std::to_string (*n) + ']';
    return true;
}

/// Reads into a new Endpoint.
Result<> readEndpoint (std::string_view written, bool relative, Endpoint& end)
{
    const auto text = trimmed (written);
    const auto wrong = [text] (const std::string& what) { return Message::error ("port/syntax", {}, quote (text) + ": " + what); };

    Reader in { text };
    if (text.empty()) return Message::error ("port/syntax", {}, "expected a port, written node.port; found nothing");

    if (relative && in.take ('['))
    {
        if (! readInstance (in, end.node)) return wrong ("an instance is written [0], [1] … or [*]; found " + in.next());
        if (! in.take ('/')) return wrong ("a / should follow the instance, as in [3]/drag.mu; found " + in.next());
        end.node += '/';
    }

    while (true)
    {
        const auto name = in.id();
        if (name.empty()) return wrong ("expected the id of a node before " + in.next() + "; " + id_rule);
        end.node += name;
        if (in.take ('[') && ! readInstance (in, end.node)) return wrong ("an instance of a node is written [0], [1] … or [*]; found " + in.next());
        if (! in.take ('/')) break;
        end.node += '/';
    }
    if (! in.take ('.'))
        return wrong (in.text.empty() ? "the port is missing; write node.port"
                                      : "found " + in.next() + " after the node; a port is written node.port, and " + id_rule);

    const auto port = in.id();
    if (port.empty()) return wrong ("expected the id of a port before " + in.next() + "; " + id_rule);
    end.port = port;
    if (in.take ('['))
    {
        const auto n = in.number();
        if (! n || ! in.take (']')) return wrong ("an entry of an array port is written in[0], in[1] …; found " + in.next());
        end.index = *n;
    }
    if (in.take ('.'))
    {
        const auto component = in.id();
        if (component != "x" && component != "y" && component != "z")
            return wrong ("a component is .x, .y or .z" + std::string (component.empty() ? "" : ", not ." + std::string (component))
                          + "; a node inside a subgraph is reached with a /, as in grain/wave.phase");
        end.component = component[0] - 'x';
    }
    if (! in.text.empty()) return wrong ("found " + in.next() + " after the port; " + id_rule);
    return {};
}

Result<Endpoint> endpointFrom (std::string_view text, bool relative)
{
    Endpoint end;
    auto read = readEndpoint (text, relative, end);
    if (! read) return std::move (read).error();
    return end;
}
}   // namespace

bool isId (std::string_view text) noexcept
{
    Reader in { text };
    return ! in.id().empty() && in.text.empty();
}

Result<Endpoint> parseEndpoint (std::string_view text) { return endpointFrom (text, false); }
Result<Endpoint> parseOverride (std::string_view text) { return endpointFrom (text, true); }

Result<Wire> parseWire (std::string_view text)
{
    Wire wire;
    auto read = readWire (text, wire);
    if (! read) return std::move (read).error();
    return wire;
}

Result<> readWire (std::string_view written, Wire& wire)
{
    constexpr std::string_view arrow = "->";
    constexpr auto form = "; a wire is written 'node.port -> node.port', with a delay 'node.port -> [1] -> node.port'";
    const auto wrong = [written] (const std::string& what) { return Message::error ("wire/syntax", {}, quote (trimmed (written)) + ": " + what); };

    auto cut = written.find (arrow);
    if (cut == std::string_view::npos) return wrong (std::string ("the -> is missing") + form);

    if (const auto from = readEndpoint (written.substr (0, cut), false, wire.from); ! from)
        return Message::error ("wire/syntax", {}, "the start of the wire: " + from.error().text);
    auto rest = trimmed (written.substr (cut + arrow.size()));

    if (rest.starts_with ('['))
    {
        Reader in { trimmed (rest.substr (1)) };
        const auto ticks = in.number();
        in.text = trimmed (in.text);
        if (! ticks || *ticks < 1 || *ticks > longest_delay || ! in.take (']'))
            return wrong ("a delay is a whole number of ticks from 1 to " + std::to_string (longest_delay) + ", written [1]");
        in.text = trimmed (in.text);
        if (! in.take (arrow)) return wrong (std::string ("a -> should follow the delay") + form);
        wire.delay = *ticks;
        rest = trimmed (in.text);
    }
    if (rest.starts_with ("(+)"))
    {
        wire.add = true;
        rest = trimmed (rest.substr (3));
    }
    if (rest.find (arrow) != std::string_view::npos) return wrong (std::string ("more than one wire in one string") + form);

    if (const auto to = readEndpoint (rest, false, wire.to); ! to)
        return Message::error ("wire/syntax", {}, "the end of the wire: " + to.error().text);
    return {};
}

std::string toText (const Endpoint& end)
{
    auto text = end.node + '.' + end.port;
    if (end.index >= 0) text += '[' + std::to_string (end.index) + ']';
    if (end.component >= 0) text.append (1, '.').append (1, static_cast<char> ('x' + end.component));
    return text;
}

std::string toText (const Wire& wire)
{
    auto text = toText (wire.from);
    if (wire.delay > 0) text += " -> [" + std::to_string (wire.delay) + ']';
    return text + (wire.add ? " -> (+) " : " -> ") + toText (wire.to);
}

}   // namespace tactus::graph
