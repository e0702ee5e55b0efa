// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/csv.hpp>
#include <tactus/kit/assets.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// A quantity that a fit needs from a recording.
struct FitColumn
{
    std::string role;   ///< "force"
    std::string unit;   ///< SI; empty: any
    bool required = true;
    std::vector<std::string> names;   ///< column names to look for if the user names none; lower case, without a unit
    std::string about;
    bool is_positive = false;   ///< where the tool is pressed on; orient() turns its sign
};

/// The columns, and their units, that the user has chosen for each role.
struct ColumnChoice
{
    std::map<std::string, std::string> names {};   ///< an empty name: not recorded, for a role that is not required
    std::map<std::string, double> units {};        ///< what 1 means, in SI
    std::map<std::string, bool> turned {};         ///< whether the sign is turned; without an entry, the recording decides: see orient()
};

/// The column that readRecording adds.
inline constexpr const char* integrated_position = "position by integration";

/// Reads numbers under a header row, separated by commas, semicolons, tabs or spaces. The header may start with #, lines about the measurement may
/// stand above it, and rows may end with empty fields: see tableIn. If strokes were recorded as time, velocity and friction without a position, the
/// table also gets `integrated_position`, in m, from the start.
/// Errors: those of readTable. [any thread]
Result<Table> readRecording (const std::filesystem::path&);

/// The samples of a WAV as a recording: the column t, and "channel 1", "channel 2" and so on.
Table tableOf (const Signal&);

/// The unit in the name of a column, such as "mm" for "Position [mm]", "Position mm" or x_mm, and "m/s" for speed_m_s; empty if there is none.
std::string unitIn (const std::string& column);

/// The size of 1 in a column, in an SI unit: 0.001 for "mm" or "1 mm" in m, 0.5 for "0.5 N" in N; a force in "g" is in gram-force. Empty if the text
/// does not fit.
std::optional<double> factorOf (const std::string& text, const std::string& si_unit);

/// The name of a column without its unit, in lower case: "x" for x_um, "normal" for "Normal [uN]".
std::string bareName (const std::string& column);

/// The index of the column for a role.
std::optional<std::size_t> findColumn (const Table&, const FitColumn&, const ColumnChoice& = {});

/// The values for a role in SI. Without a choice of the user, the unit follows from the name of the column, such as x_um, "Force [mN]" or
/// force_gf; a name without a unit is in SI. Empty if the column is missing and not required. Errors: fit/column, fit/unit.
Result<std::vector<double>> columnOf (const Table&, const std::string& file, const FitColumn&, const ColumnChoice& = {});

/// The values of each role in SI; empty for what was not recorded.
using RecordedColumns = std::map<std::string, std::vector<double>>;

}   // namespace tactus::host
