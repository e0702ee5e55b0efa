// SPDX-License-Identifier: MIT
#include "wire_fit.hpp"
#include <tactus/plan/values.hpp>

#include <tactus/graph/endpoint_text.hpp>

namespace tactus::plan
{

bool readGain (const graph::Wire& wire, FlatWire& w, Flat& flat)
{
    if (wire.gain.is_null()) return true;
    const auto read = readNumber (wire.gain);
    if (! read)
    {
        flat.error ("wire/gain", flat.at (w.origin, "gain"), "gain of \"" + graph::toText (wire) + "\": " + read.error().text,
                    "give a number, or text with a unit such as \"1e-4 m/N\"");
        return false;
    }
    w.gain = read->value;
    w.gain_dimension = read->dimension;
    return true;
}

bool wireFits (const FlatWire& w, Flat& flat)
{
    const auto& to = flat.sheet (w.to);
    for (const auto& end : { w.from, std::optional { w.to } })
        if (end && flat.sheet (*end).list && end->index < 0)
        {
            const auto name = flat.nameOf (*end);
            flat.error ("wire/which_entry", w.origin, "\"" + graph::toText (*w.written) + "\" does not name an entry of the array port '" + name + "'",
                        "write " + name + "[0]");
            return false;
        }
    if (! to.choices.empty())
    {
        flat.error ("wire/onto_choice", w.origin, "'" + flat.nameOf (w.to) + "' takes one of a list of names, so nothing can be wired to it",
                    "set the parameter under `params`");
        return false;
    }
    if (w.add && w.to.role != Role::param)
    {
        flat.error ("wire/add_to_input", w.origin, "(+) adds to a parameter's stored value, but '" + flat.nameOf (w.to) + "' is an input", "leave out (+)");
        return false;
    }
    if (w.from && flat.widthOf (*w.from) != flat.widthOf (w.to))
    {
        const bool vector_first = flat.widthOf (*w.from) == 3;
        flat.error ("wire/width", w.origin,
                    "'" + flat.nameOf (*w.from) + (vector_first ? "' is a vector and '" : "' is a scalar and '") + flat.nameOf (w.to)
                        + (vector_first ? "' a scalar" : "' a vector"),
                    vector_first ? "wire one component, as in " + flat.nameOf (*w.from) + ".x"
                                 : "wire it to one component, as in " + flat.nameOf (w.to) + ".x");
        return false;
    }
    return true;
}

}   // namespace tactus::plan
