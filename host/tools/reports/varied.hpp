// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/plan.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// The quantity that varies along an axis.
struct Varied
{
    enum class What
    {
        stiffness,
        damping,
        rate,
        param
    };

    What what = What::stiffness;
    std::string name {}, unit {};   // a param: NODE.PARAM
    double from = 0.0, to = 0.0;
    double now = 0.0;        // at the working point
    std::size_t param = 0;   // in Contact::varied
};

/// Reads WHAT=FROM:TO of an option, and adds a param to `params`; for anything but a param, the working point is filled in later. Refuses if it
/// is wrong.
Varied readVaried (const std::string& option, const std::string& text, const Plan&, std::vector<std::string>& params);

}   // namespace tactus::host
