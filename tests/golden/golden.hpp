// SPDX-License-Identifier: MIT
#pragma once

/// Golden sets: tests/golden/NAME.csv contains inputs and expected outputs of a model, one row per sample, computed by an
/// independent program. NAME.json contains the parameters and tolerances.

#include <tactus/text/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace tactus::test
{

class Golden
{
public:
    explicit Golden (const std::string& name)
    {
        const std::string path = std::string (TACTUS_SOURCE_DIR) + "/tests/golden/" + name;
        std::ifstream csv (path + ".csv"), json (path + ".json");
        if (! csv || ! json) throw std::runtime_error ("there is no golden set " + path);
        about = Json::parse (std::string { std::istreambuf_iterator<char> (json), {} });

        std::string line, cell;
        std::getline (csv, line);
        for (std::istringstream header (line); std::getline (header, cell, ',');)
            names.push_back (cell);
        while (std::getline (csv, line))
        {
            auto& row = table.emplace_back();
            for (std::istringstream cells (line); std::getline (cells, cell, ',');)
                row.push_back (std::stod (cell));
        }
    }

    std::size_t rows() const { return table.size(); }

    double operator() (std::size_t row, const std::string& column) const
    {
        const auto at = std::ranges::find (names, column);
        if (at == names.end()) throw std::runtime_error ("there is no golden column " + column);
        return table[row][static_cast<std::size_t> (at - names.begin())];
    }

    double param (const std::string& name) const { return about["params"][name].get<double>(); }
    double dt_s() const { return about["T"].get<double>(); }

    /// The tolerance of a column: the entry with the longest matching prefix.
    double tolerance (const std::string& column) const
    {
        std::string best;
        for (const auto& [prefix, value] : about["tolerance"].items())
            if ((prefix == "*" && best.empty()) || (column.starts_with (prefix) && prefix.size() > best.size())) best = prefix;
        const auto& found = about["tolerance"][best];
        return found.is_string() ? 0.0 : found["abs"].get<double>();
    }

    /// The largest error of actual (row) over all rows, in units of the column's tolerance. If the tolerance is zero, it
    /// is 0 or inf.
    template <typename Actual>
    double worst (const std::string& column, Actual actual) const
    {
        double most = 0.0;
        for (std::size_t i = 0; i < rows(); ++i)
        {
            const double error = std::abs (actual (i) - (*this) (i, column));
            if (! (error <= 0.0)) most = std::max (most, std::isnan (error) ? std::numeric_limits<double>::infinity() : error / tolerance (column));
        }
        return most;
    }

private:
    Json about;
    std::vector<std::string> names;
    std::vector<std::vector<double>> table;
};

}   // namespace tactus::test
