// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <deque>

namespace tactus::host
{

/// The lowest and the highest value of each component of a port during a short time.
struct CourseColumn
{
    std::array<double, 3> low {}, high {};

    bool operator== (const CourseColumn&) const = default;
};

/// The recent course of a port, the oldest column first.
using Course = std::deque<CourseColumn>;

}   // namespace tactus::host
