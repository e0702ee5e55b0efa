// SPDX-License-Identifier: MIT
#pragma once

/// Limits of what the files of a graph may cost, so that a file from a stranger can neither hang the program nor fill the memory. Costs are counted,
/// not measured: the same files are accepted or refused on every computer. The defaults keep the loading of any file to about 5 s and 500 MB.
/// `tactus validate`, `render` and `play` change them with --limits.
///
/// These limits are not budgets, because they protect the stack or tell files apart: 64 levels of JSON (deepest_nesting), 32
/// levels of subgraphs and of included files, 64 levels of an expression, and 512 KB in a line of a CSV.

#include "message.hpp"
#include "result.hpp"

#include <string>
#include <string_view>

namespace tactus
{

struct Budgets
{
    double file = 64e6;       ///< a measurement of a minute at 48 kHz as text takes 30 MB
    double reading = 256e6;   ///< four of the largest files
    double values = 1e6;      ///< a graph of a thousand nodes has 20 000
    double files = 1000;      ///< each costs a few system calls
    double numbers = 1e7;     ///< ten minutes of a trace at 4 kHz
    double points = 5e5;      ///< a hand cannot feel the details of a finer mesh
    double triangles = 1e6;   ///< a closed mesh has two triangles for each point
    double roles = 1000;      ///< each opens a device
    double nodes = 2e5;       ///< a processor core computes about 10 000 nodes in a tick
    double wires = 1e6;       ///< five for each node
    double runs = 1e7;        ///< a thousand nodes at 1 MHz in a graph at 100 Hz; a tenth of a second of a processor core
    double memory = 450e6;    ///< the largest height map, 2048 times 2048, takes 412 MB
    double time = 5.0;        ///< as long as a person waits for a file to open
};

/// A budget as --limits and messages name it.
struct BudgetSheet
{
    std::string_view name;
    double Budgets::*value;
    std::string_view unit;   ///< "bytes", "s", or what is counted
    std::string_view about;
};

inline constexpr BudgetSheet budget_sheets[] {
    { "file", &Budgets::file, "bytes", "size of a file" },
    { "reading", &Budgets::reading, "bytes", "all files of a graph; a pixel or sample counts 8 more, a number in a table 16, a point of a mesh 200" },
    { "values", &Budgets::values, "values", "numbers, texts, lists and objects in a graph file and the files that it includes" },
    { "files", &Budgets::files, "files", "files that a graph includes" },
    { "numbers", &Budgets::numbers, "numbers", "numbers, pixels or samples in a table, picture or recording" },
    { "points", &Budgets::points, "points", "points of a mesh" },
    { "triangles", &Budgets::triangles, "triangles", "triangles of a mesh" },
    { "roles", &Budgets::roles, "roles", "roles of a graph" },
    { "nodes", &Budgets::nodes, "nodes", "nodes and instances of subgraphs, with all subgraphs expanded" },
    { "wires", &Budgets::wires, "wires", "wires with all subgraphs expanded; also values given to instances" },
    { "runs", &Budgets::runs, "runs", "how often nodes run in one tick of the graph, those in `times` sections as often as the section" },
    { "memory", &Budgets::memory, "bytes", "estimated memory of the nodes, with their settings and delays" },
    { "time", &Budgets::time, "s", "estimated time of compiling; the work is counted, and a unit of work takes 5 ns" },
};

/// The time in s that a unit of work takes, such as the arithmetic of one sample. Measured on a slow desktop computer.
inline constexpr double work_unit_s = 5e-9;

/// The budgets of this process. [any thread]
const Budgets& budgets() noexcept;

/// Call this before anything is loaded. [main thread]
void setBudgets (const Budgets&) noexcept;

/// Reads the value of --limits, "time=60s,memory=4GB"; budgets that it does not name keep their defaults. Amounts may end in
/// k, M or G, those in bytes also in B, kB, MB or GB, and the time in s. Error: limits/value.
Result<Budgets> readLimits (std::string_view);

/// The error for something that takes more than a budget allows. `what` begins the sentence, `remedy` names what else helps;
/// `needed` is what was counted when the budget was exceeded.
Message overBudget (std::string id, double Budgets::*which, const std::string& what, double needed, const std::string& remedy);

/// Starts a new account of the budget `reading`, for the files that this thread reads from now on. Loading and compiling a graph do
/// this. [any thread]
void beginReading() noexcept;

/// Charges bytes to this account. False if it exceeds the budget. [any thread]
bool chargeReading (double bytes) noexcept;

/// The error for a file with which the account exceeds the budget.
Message overReading (std::string id, const std::string& what);

}   // namespace tactus
