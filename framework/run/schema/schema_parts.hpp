// SPDX-License-Identifier: MIT
#pragma once

/// Parts of the schema of graph files.

#include <tactus/node/catalogue.hpp>
#include <tactus/text/json.hpp>

#include <map>
#include <string>
#include <string_view>

namespace tactus::schema
{

/// The part of the schema that is the same for every catalogue.
Json base();

Json reference (const std::string& definition);    ///< to "#/$defs/DEFINITION"
Json never (const std::string& message);           ///< what is never right, with the message that editors show for it
Json listOf (Json entries, int least, int most);   ///< most: -1 for any number

/// Numbers and strings with a unit.
class Quantities
{
public:
    /// A quantity in this range, of this dimension; null: of any.
    Json of (const Unit*, const Interval& hard = {});

    /// Adds the definitions that of() refers to.
    void define (Json& definitions) const;

private:
    std::map<std::string, Unit> used;   ///< by the name of the definition
};

/// Adds what refuses the misspellings of its properties to the schema of an object that may have properties of other people, too.
void refuseMisspelt (Json& object);

/// The params and settings of a node type, and which other keys its nodes may have.
Json nodeOf (const NodeType&, Quantities&);

/// The description of a device in a graph, and its guard.
Json deviceOf (Quantities&);

}   // namespace tactus::schema
