// SPDX-License-Identifier: MIT
#pragma once

#include <host/code/generate/walk/plan_addresses.hpp>
#include <tactus/plan/plan.hpp>
#include <tactus/plan/steps/fused_tick.hpp>

#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tactus::host
{

/// The places of a plan's values while fused code runs: local variables where possible, else the memory where the plan has them. [main thread]
///
/// Code that reads a value needs it in memory unless a variable with the value is in scope. This may be known only after the code for
/// the value has been written, so the code is written again until nothing new is needed; see settled().
class FusedValues
{
public:
    /// The plan must outlive this object.
    explicit FusedValues (const Plan&);

    const Plan& plan;

    /// The number of an object in FusedTick::objects.
    std::string number (const void*);

    /// Gives these objects consecutive numbers; returns the first one.
    std::string numbers (std::initializer_list<const void*>);

    const std::vector<void*>& objects() const noexcept { return all; }

    /// The place where code that reads a value finds it.
    struct Place
    {
        enum class Kind
        {
            variable,   ///< in the variable `name`
            member,     ///< in a member of `name`, which has the outputs of a node
            constant,   ///< it never changes
            memory      ///< where the plan has it
        };

        Kind kind = Kind::memory;
        std::string name {};
        const PortSheet* sheet = nullptr;   ///< the row of the member
        int slot = 0;                       ///< the component of the member
    };

    /// Finds a value. Notes that it must be in memory if no variable with it is in scope.
    Place find (const double*);

    /// Notes that a value must be in memory, because something other than fused code reads it.
    void need (const double*);
    void need (const Record&);   ///< the same for all that a record reads

    bool isNeeded (const double* value) const { return has_unknown || needed.contains (value); }
    bool isNeeded (std::size_t instance) const { return has_unknown || needed_nodes.contains (instance); }
    bool isInSight (const double* value) const;

    /// From here to the end of the scope, this variable has the value.
    void name (const double* value, std::string variable) { scopes.back().values.insert_or_assign (value, std::move (variable)); }

    /// From here to the end of the scope, this variable has the outputs of a node.
    void nameOutputs (std::size_t instance, std::string variable) { scopes.back().outputs.insert_or_assign (instance, std::move (variable)); }

    void openScope() { scopes.emplace_back(); }
    void closeScope() { scopes.pop_back(); }

    /// Prepares for writing the code again. True if nothing new was needed the last time.
    bool settled();

private:
    struct Scope
    {
        std::unordered_map<const double*, std::string> values;
        std::unordered_map<std::size_t, std::string> outputs;
    };

    void findChanging (std::span<const Record>);
    bool isNode (const Record&) const;
    bool isConstant (const double*) const;
    std::optional<Place> variableOf (const double*) const;

    const PlanAddresses addresses;
    std::vector<Scope> scopes { 1 };
    std::vector<void*> all;
    std::unordered_map<const void*, std::size_t> by_object;
    std::unordered_map<const void*, std::size_t> by_node;   // the number of an instance, by its node
    std::unordered_set<const double*> changing;             // what sums, hits, delays and rate converters write
    bool has_unknown = false;                               // the plan has records of an unknown kind, which may read and write anything
    std::set<const double*> needed;
    std::set<std::size_t> needed_nodes;
    std::size_t needed_before = 0;
};

}   // namespace tactus::host
