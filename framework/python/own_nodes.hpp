// SPDX-License-Identifier: MIT
#pragma once

#include "messages.hpp"

#include <tactus/node/catalogue.hpp>

#include <exception>
#include <memory>
#include <optional>
#include <vector>

namespace tactus::python
{

struct OwnType;

/// The node types that a Python program adds to the catalogue of one run. They call Python on each tick, so they are for offline runs.
class OwnNodes
{
public:
    /// Takes the descriptions that tactus/_own.py makes. [with the GIL]
    explicit OwnNodes (const py::list& descriptions);
    ~OwnNodes();
    OwnNodes (const OwnNodes&) = delete;
    OwnNodes& operator= (const OwnNodes&) = delete;

    const Catalogue& catalogue() const noexcept { return own ? *own : tactus::catalogue(); }
    bool isEmpty() const noexcept { return types.empty(); }

    /// True once Python code of a node has raised an exception; from then on, the outputs of all nodes in Python are 0. [any thread that ticks]
    bool haveFailed() const noexcept { return have_failed; }

    /// If Python code of a node has raised an exception, raises it again, but only once. [with the GIL]
    void raiseFailure();

    /// Keeps the exception that is being handled. [with the GIL]
    void noteFailure() noexcept
    {
        failure = std::current_exception();
        have_failed = true;
    }

private:
    std::vector<std::unique_ptr<OwnType>> types;
    std::optional<Catalogue> own;
    std::exception_ptr failure;
    bool have_failed = false;
};

}   // namespace tactus::python
