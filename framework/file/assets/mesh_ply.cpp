// SPDX-License-Identifier: MIT
#include "binary.hpp"
#include "mesh_parts.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace tactus::readers
{

namespace
{
using Take = std::optional<double> (*) (std::string_view& bytes, std::endian);

template <typename T>
std::optional<double> take (std::string_view& bytes, std::endian order)
{
    const auto value = takeNumber<T> (bytes, order);
    if (! value) return std::nullopt;
    return static_cast<double> (*value);
}

struct Type
{
    std::string_view names[2];
    Take take;
};
constexpr Type types[] = {
    { { "char", "int8" }, take<std::int8_t> },
    { { "uchar", "uint8" }, take<std::uint8_t> },
    { { "short", "int16" }, take<std::int16_t> },
    { { "ushort", "uint16" }, take<std::uint16_t> },
    { { "int", "int32" }, take<std::int32_t> },
    { { "uint", "uint32" }, take<std::uint32_t> },
    { { "float", "float32" }, take<float> },
    { { "double", "float64" }, take<double> },
};

struct Property
{
    std::string_view name;
    Take length;   // reads the length of a list; null for a single number
    Take value;
};

struct Element
{
    std::string_view name;
    long long count;
    std::vector<Property> properties;
};

struct Header
{
    bool text = true;
    std::endian order = std::endian::little;
    std::vector<Element> elements;
};

Take typeNamed (std::string_view name, std::size_t line)
{
    const auto found = std::ranges::find_if (types, [&] (const Type& t) { return t.names[0] == name || t.names[1] == name; });
    if (found == std::end (types)) throw MeshProblem { "mesh/syntax", quote (name) + " is not a number type", line };
    return found->take;
}

Header readHeader (Lines& lines)
{
    Header header;
    const auto first = lines.next();
    if (! first || (first->substr (0, 3) != "ply" && first->substr (0, 3) != "PLY") || first->find_first_not_of (" \t", 3) != first->npos)
        throw MeshProblem { "mesh/syntax", "it does not start with the word ply", 1 };
    while (auto line = lines.next())
    {
        const auto keyword = takeWord (*line);
        if (keyword == "end_header") return header;
        if (keyword == "format")
        {
            const auto format = takeWord (*line);
            header.text = format == "ascii";
            header.order = format == "binary_big_endian" ? std::endian::big : std::endian::little;
            if (! header.text && format != "binary_big_endian" && format != "binary_little_endian")
                throw MeshProblem { "mesh/syntax", "its format is unknown", lines.number() };
        }
        if (keyword == "element")
        {
            const auto name = takeWord (*line);
            header.elements.push_back ({ name, wholeNumber (takeWord (*line), lines.number()), {} });
        }
        if (keyword == "property")
        {
            if (header.elements.empty()) throw MeshProblem { "mesh/syntax", "a property does not belong to an element", lines.number() };
            Property p {};
            auto type = takeWord (*line);
            if (type == "list")
            {
                p.length = typeNamed (takeWord (*line), lines.number());
                type = takeWord (*line);
            }
            p.value = typeNamed (type, lines.number());
            p.name = takeWord (*line);
            header.elements.back().properties.push_back (p);
        }
    }
    throw MeshProblem { "mesh/truncated", "its header does not end", lines.number() };
}

/// The numbers after the header, in order.
class Body
{
public:
    Body (const Header& header, const Lines& above) noexcept : text (header.text), order (header.order), lines (above), bytes (above.behind()) {}

    double number (Take type)
    {
        const auto value = text ? numberIn<double> (nextWord()) : type (bytes, order);
        if (! value) throw MeshProblem { "mesh/syntax", text ? "a value is not a number" : "it ends before its last element", line() };
        return *value;
    }

    long long wholeNumber (Take type)
    {
        const double value = number (type);
        if (! (value >= 0.0 && value <= std::numeric_limits<int>::max())) throw MeshProblem { "mesh/syntax", "a count or point index is out of range", line() };
        return static_cast<long long> (value);
    }

    std::size_t line() const noexcept { return text ? lines.number() : 0; }

private:
    std::string_view nextWord()
    {
        for (;;)
        {
            if (const auto word = takeWord (bytes_of_line); ! word.empty()) return word;
            const auto next = lines.next();
            if (! next) throw MeshProblem { "mesh/truncated", "it ends before its last element", lines.number() };
            bytes_of_line = *next;
        }
    }

    bool text;
    std::endian order;
    Lines lines;
    std::string_view bytes, bytes_of_line;
};

void readPoint (const Element& element, Body& body, MeshBuilder& mesh)
{
    Vec3 at = Vec3::Zero();
    for (const auto& p : element.properties)
        if (p.length != nullptr)
            for (auto left = body.wholeNumber (p.length); left > 0; --left)
                body.number (p.value);
        else if (const double value = body.number (p.value); p.name == "x" || p.name == "y" || p.name == "z")
            at[p.name[0] - 'x'] = value;
    mesh.point (at, body.line());
}

void readFace (const Element& element, Body& body, MeshBuilder* mesh)
{
    std::vector<long long> corners;
    for (const auto& p : element.properties)
    {
        if (p.length == nullptr)
        {
            body.number (p.value);
            continue;
        }
        const bool wanted = mesh != nullptr && (p.name == "vertex_indices" || p.name == "vertex_index");
        const auto count = body.wholeNumber (p.length);
        const auto all = corners.size() + static_cast<std::size_t> (count);
        if (wanted && all > 2) checkBudget (&Budgets::triangles, all - 2, body.line());   // before they are kept
        for (auto left = count; left > 0; --left)
            if (wanted)
                corners.push_back (body.wholeNumber (p.value));
            else
                body.number (p.value);
    }
    if (mesh != nullptr) mesh->face (corners, body.line());
}
/// Reads strips of triangles, as scanners write them. Each point makes a triangle with the two points before it, and every second triangle runs the other
/// way round. -1 begins a new strip.
void readStrips (const Element& element, Body& body, MeshBuilder& mesh)
{
    for (const auto& p : element.properties)
    {
        if (p.length == nullptr)
        {
            body.number (p.value);
            continue;
        }
        const bool wanted = p.name == "vertex_indices" || p.name == "vertex_index";
        std::vector<long long> strip;
        for (auto left = body.wholeNumber (p.length); left > 0; --left)
        {
            const double number = body.number (p.value);
            if (! wanted) continue;
            if (number == -1.0)
            {
                strip.clear();
                continue;
            }
            if (! (number >= 0.0 && number <= std::numeric_limits<int>::max()))
                throw MeshProblem { "mesh/syntax", "a point index is out of range", body.line() };
            strip.push_back (static_cast<long long> (number));
            const auto n = strip.size();
            if (n < 3) continue;
            const bool turned = n % 2 == 0;
            mesh.face (std::array { strip[n - 3], strip[turned ? n - 1 : n - 2], strip[turned ? n - 2 : n - 1] }, body.line());
        }
    }
}
}   // namespace

/// Reads text or binary PLY: x, y and z of the points, the point list of the faces, and strips of triangles. Ignores the rest.
void readPly (std::string_view bytes, MeshBuilder& mesh)
{
    Lines lines (bytes);
    const auto header = readHeader (lines);
    Body body (header, lines);
    for (const auto& element : header.elements)
    {
        if (element.properties.empty()) continue;   // no data in the file, however many elements the header claims
        for (long long i = 0; i < element.count; ++i)
            if (element.name == "vertex")
                readPoint (element, body, mesh);
            else if (element.name == "tristrips")
                readStrips (element, body, mesh);
            else
                readFace (element, body, element.name == "face" ? &mesh : nullptr);
    }
}

}   // namespace tactus::readers
