// SPDX-License-Identifier: MIT
#pragma once

#include "recording.hpp"

#include <tactus/fit/fit_report.hpp>
#include <tactus/graph/graph.hpp>
#include <tactus/text/json.hpp>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tactus::host
{

enum class FitKind
{
    friction,
    modes,
    texture,
    grating,
    blade,
    curve,
    key_switch,
    shock
};

/// The description of a kind of fit, for the command line and the window.
struct FitKindInfo
{
    FitKind kind;
    std::string id;      ///< on the command line
    std::string name;    ///< in the window
    std::string about;   ///< what is fitted, in one sentence
    std::vector<FitColumn> columns;
};

const std::vector<FitKindInfo>& fitKinds();
const FitKindInfo& infoOf (FitKind);

/// The kind that the columns suggest. For depth and force, it also depends on the values. Empty if no kind fits.
std::optional<FitKind> guessKind (const Table&);

/// Values that the recording does not contain. A value of 0 means that the user gave none; then the default in the comment is used.
struct FitSettings
{
    ColumnChoice columns {};
    double rate = 0.0;                      ///< rows per second, for a recording without times; modes, texture, shock
    double load = 0.0;                      ///< N; friction, grating: default 1
    double mass = 0.0;                      ///< kg; shock: by default from the times; texture: default 10 g; modes
    double speed = 0.0;                     ///< m/s; modes: of the blow; texture: of the stroke
    double force = 0.0;                     ///< N; texture: normal to the surface
    double width = 0.0;                     ///< m; blade: default 20 mm
    std::optional<double> touch {};         ///< m; depth at which the tool touches; by default, see orient()
    std::optional<double> from {}, to {};   ///< s; modes: the fitted part
    std::optional<double> blow {};          ///< s; modes: the time of the blow
    int most = 0;                           ///< modes, coefficients or harmonics
    int points = 20;                        ///< curve
    double mu = 0.3, ratio = 0.45;          ///< curve
    double tolerance = 10e-3;               ///< N; switch: largest distance between the recording and the straight lines that replace it
    double stiffness = 1e4;                 ///< N/m; switch: with which the force changes between both ways when the finger reverses
    double backlash = 0.0;                  ///< m; switch: of the meter
};

/// A fit, and a graph in which it can be felt.
struct FittedGraph
{
    FitKind kind {};
    FitReport report {};
    graph::Graph preset {};
    std::vector<std::string> nodes {};      ///< names of the fitted nodes in the preset
    std::vector<std::string> details {};    ///< lines about this kind
    std::vector<std::string> snippets {};   ///< lines with parts of graph files
    Messages warnings {};                   ///< each is also a reason why the verdict is poor
};

/// "good" or "poor", which every text about a fit says.
std::string verdictOf (const FitReport&);

/// Fits a recording. `file` is named in messages and in the preset. Errors: fit/…; see framework/fit. [any thread]
Result<FittedGraph> fitRecording (FitKind, const Table&, const std::string& file, const FitSettings&, FitCourse* = nullptr);

/// The recorded data, before it is fitted.
struct RecordedPicture
{
    FitPicture picture {};             ///< the second column of a kind over the first; empty if the columns cannot be read
    std::set<std::string> turned {};   ///< the roles whose sign is turned
};

/// The picture that a fit with these settings would see. [any thread]
RecordedPicture pictureOf (FitKind, const Table&, const FitSettings&);

/// "0.472 [0.468, 0.475]", with a unit and a prefix where they help.
std::string textOf (const FitValue&);

/// The report for a terminal, a line for each value.
std::string textOf (const FitReport&);

/// The report as data, in SI units. An infinite bound is null.
Json jsonOf (const FitReport&);

/// The JSON of `tactus fit --json`, about the fit of a recording whose preset is in this file.
Json jsonOf (const FittedGraph&, const std::string& recording, const std::string& preset);

/// An error if the nodes refuse the fitted values. Id: fit/preset.
Result<> checkFitted (const FittedGraph&, const std::string& recording, Assets&);

}   // namespace tactus::host
