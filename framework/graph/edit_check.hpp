// SPDX-License-Identifier: MIT
#pragma once

#include "edit.hpp"

#include <tactus/text/message.hpp>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace tactus
{
class Catalogue;
}

namespace tactus::graph
{

/// An error of a graph. `place` says what is wrong, and stays the same when other nodes and wires come and go: a JSON pointer, in which
/// the id of a wire replaces its number.
struct Problem
{
    std::string place;
    Message message;
};

/// Says whether a node type that is not in the catalogue is one that the program will add when it plays the graph.
using KnownElsewhere = std::function<bool (const std::string& type)>;

/// All errors of a graph. [main thread]
using FindProblems = std::function<std::vector<Problem> (const Graph&)>;

/// Compiles a graph, except for its files, against the types of this catalogue, which must outlive it. framework/plan/edit_problems.cpp
/// defines it, because graphs know nothing of compiling.
FindProblems problemsAgainst (const Catalogue&, KnownElsewhere);

/// False if no rule of compiling is about what the command changes, or if the command loads a graph, which may have errors.
bool mayAddError (const Command&);

/// The place that an edit writes itself, or the first of them; empty if there is none.
std::string placeOf (const Command&);

/// The first error after edits that they have added: what is wrong was right before, or an edit itself has written it.
const Message* firstAdded (const std::vector<Problem>& before, const std::vector<Problem>& after, std::span<const Command>);

}   // namespace tactus::graph
