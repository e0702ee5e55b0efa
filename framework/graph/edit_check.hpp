// SPDX-License-Identifier: MIT
#pragma once

#include "edit.hpp"

#include <tactus/text/message.hpp>

#include <functional>
#include <memory>
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

/// Knows the errors of a graph against the catalogue. The History of the graph owns it. [main thread]
class EditCheck
{
public:
    virtual ~EditCheck() = default;

    /// The graph has changed otherwise than by an edit that the functions below have seen.
    virtual void forget() = 0;

    /// False if a command that has just been carried out surely adds no error. This looks only at what the command touches. If it is true,
    /// problems() comes next: with this graph, and if that has any, with the graph before.
    virtual bool mayAddError (const Graph&, const Command&) = 0;

    /// All errors of a graph.
    virtual std::vector<Problem> problems (const Graph&) = 0;
};

/// Says whether a node type that is not in the catalogue is one that the program will add when it plays the graph.
using KnownElsewhere = std::function<bool (const std::string& type)>;

/// Checks against the types of this catalogue, which must outlive it. framework/plan/edit_check/edit_check.cpp defines it, because the checks are
/// those of compiling.
std::unique_ptr<EditCheck> makeEditCheck (const Catalogue&, KnownElsewhere);

/// The places that an edit writes itself.
std::vector<std::string> placesOf (const Command&);

/// The first error after an edit that the edit has added: what is wrong was right before, or the edit itself has written it.
const Message* firstAdded (const std::vector<Problem>& before, const std::vector<Problem>& after, const Command&);

}   // namespace tactus::graph
