// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/document.hpp>
#include <host/app/model/patch.hpp>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The way from a graph into the patch that is shown: the subgraphs that were entered, and the instance of each whose values are shown. [main thread]
class Trail
{
public:
    explicit Trail (const Document& d) : document (d) {}

    /// The name of each node that was entered, and of its subgraph, from the outside in.
    using Entries = std::vector<std::pair<std::string, std::string>>;
    const Entries& entries() const noexcept { return entered; }
    std::string patch() const { return entered.empty() ? std::string {} : entered.back().second; }
    SeenPatch seen() const;   ///< the patch, and the way into it

    void enter (std::string node, std::string subgraph) { entered.emplace_back (std::move (node), std::move (subgraph)); }
    void leaveTo (std::size_t depth) { entered.resize (depth); }
    bool goTo (const std::string& patch);   ///< false if it cannot be reached from the root

    /// Follows renamed nodes and subgraphs after an edit, and ends before the first node that no longer exists.
    void follow();

    struct Instance
    {
        int number = 0, count = 1;

        bool operator== (const Instance&) const = default;
    };
    std::optional<Instance> instance() const;   ///< of the current subgraph; empty if it has no `count`
    void chooseInstance (int number) { chosen_instances[seen().path] = number; }

    /// The full path of a port in the patch: "grain/wave.value"; with the numbers of the chosen instances: "finger[2]/drag.force".
    std::string address (const std::string& port) const;

private:
    std::optional<Instance> instanceOf (const graph::Node&, const std::string& names) const;

    const Document& document;
    Entries entered;
    std::map<std::string, int> chosen_instances;   // by the path of a subgraph node, without numbers
};

}   // namespace tactus::host
