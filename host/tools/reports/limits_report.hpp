// SPDX-License-Identifier: MIT
#pragma once

#include "limit_regions.hpp"

#include <tactus/text/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace tactus::host
{

struct LimitsOptions
{
    std::string role {};                     ///< whose contact is examined; empty: the one with the heaviest contact
    std::string x {}, y {};                  ///< what varies, as for the options --x and --y; empty: the usual views
    int steps = 40;                          ///< along each axis
    double duration_s = 0.0;                 ///< of the motion; 0: as long as the longest path of a hand
    std::function<void()> checkOn = [] {};   ///< called for each point of a picture or a table; may throw to end the search
};

/// The limits of the heaviest contact of a graph, as `tactus limits` reports them. [main thread]
class LimitsReport
{
public:
    /// Throws Refusal, or UsageError for a wrong x or y.
    LimitsReport (CheckedGraph&, const LimitsOptions&);

    LimitsReport (const LimitsReport&) = delete;
    LimitsReport& operator= (const LimitsReport&) = delete;

    /// The JSON of `tactus limits --json`.
    Json json() const;

    /// The same, with the points of all views: `columns` and `rows`. Values that are not finite are null.
    Json jsonWithRows() const;

    std::vector<View> views() const;   ///< what x and y name, or the usual ones

private:
    const CheckedGraph& graph;
    std::vector<Varied> axes;

public:
    Contact contact;
    LimitRegions regions;
    Limits passive, stable;
};

}   // namespace tactus::host
