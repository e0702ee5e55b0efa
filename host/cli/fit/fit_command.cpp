// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/cli/amount.hpp>
#include <host/cli/overwriting.hpp>
#include <host/cli/report.hpp>
#include <host/tools/figures/plot.hpp>
#include <host/tools/fitting/recording_file.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <utility>

namespace tactus::host
{

namespace
{
std::pair<std::string, std::string> roleAndText (const std::string& option, const std::string& given, const FitKindInfo& info)
{
    const auto equals = given.find ('=');
    std::string roles;
    for (const auto& column : info.columns)
    {
        if (equals != std::string::npos && given.substr (0, equals) == column.role) return { column.role, given.substr (equals + 1) };
        addToList (roles, column.role);
    }
    throw UsageError (option, quote (given) + " does not fit; write ROLE=… with one of the roles " + roles);
}

void readChoices (FitCommandOptions& options, const FitKindInfo& info)
{
    for (const auto& given : options.columns)
        options.settings.columns.names.insert (roleAndText ("--column", given, info));
    for (const auto& given : options.units)
    {
        const auto [role, text] = roleAndText ("--unit", given, info);
        const auto column = std::ranges::find (info.columns, role, &FitColumn::role);
        if (column->unit.empty()) throw UsageError ("--unit", role + " may have any unit; leave out this option");
        options.settings.columns.units[role] = readAmount ("--unit", text, column->unit.c_str(), ("1 " + column->unit).c_str());
    }
    for (const auto& given : options.signs)
    {
        const auto [role, text] = roleAndText ("--sign", given, info);
        if (text != "+" && text != "-") throw UsageError ("--sign", quote (given) + " does not fit; write " + role + "=+ or " + role + "=-");
        options.settings.columns.turned[role] = text == "-";
    }
}

void drawFit (const FitPicture& picture, const std::string& title, const std::string& file)
{
    Axes axes { .x = { picture.x_name, picture.x_unit }, .y = { picture.y_name, picture.y_unit } };
    for (const auto& curve : picture.curves)
        axes.series.push_back ({ .label = curve.label, .x = curve.x, .y = curve.y });
    orFail (writeFigure ({ .title = title, .panels = { axes } }, file));
}

void printFit (const FittedGraph& made, const FitCommandOptions& options)
{
    const auto& info = infoOf (made.kind);
    if (options.json)
    {
        auto json = host::jsonOf (made.report);
        json["kind"] = info.id;
        json["recording"] = options.recording;
        json["preset"] = options.preset;
        std::cout << json.dump (2) << "\n";
        return;
    }
    std::cout << printableName (options.recording) << ": " << made.report.rows << " rows, " << info.about << "\n"
              << host::textOf (made.report);
    for (const auto* lines : { &made.details, &made.snippets })
        for (const auto& line : *lines)
            std::cout << "  " << line << "\n";
    std::cout << "wrote " << printableName (options.preset) << "\n";
}

/// Ends the command if the nodes refuse the fitted values.
void checkPreset (const FittedGraph& made, const std::string& recording)
{
    FileAssets assets;
    const auto compiled = compile (made.preset, catalogue(), { .assets = &assets });
    const auto error = std::ranges::find (compiled.messages, Message::Severity::error, &Message::severity);
    if (error == compiled.messages.end()) return;
    fail (Message::error ("fit/preset", recording, "the fitted values cannot be played: " + error->text,
                          "the recording does not look like one of this kind: check the columns and their units"));
}

void runFit (FitKind kind, FitCommandOptions options)
{
    readChoices (options, infoOf (kind));
    std::vector<std::string> outputs { options.preset };
    if (! options.plot.empty()) outputs.push_back (options.plot);
    refuseOverwriting (outputs, { options.recording });

    const auto table = orFail (readRecordingOrWav (options.recording));
    auto made = orFail (fitRecording (kind, table, options.recording, options.settings));
    made.preset.name = std::filesystem::path (options.preset).stem().string();
    checkPreset (made, options.recording);
    orFail (saveGraph (made.preset, options.preset));
    if (! options.plot.empty()) drawFit (made.report.picture, std::filesystem::path (options.recording).filename().string(), options.plot);
    printFit (made, options);
    for (const auto& warning : made.warnings)
        warn (options.recording, warning);
}
}   // namespace

void FitCommand::addAmount (const std::string& option, const char* si_unit, const char* example, const std::string& about,
                            const std::function<void (FitSettings&, double)>& take) const
{
    command.addOption (
        option,
        [target = options, option, si_unit, example, take] (const std::string& text) { take (target->settings, readAmount (option, text, si_unit, example)); },
        about);
}

void FitCommand::addSignedAmount (const std::string& option, const char* si_unit, const char* example, const std::string& about,
                                  const std::function<void (FitSettings&, double)>& take) const
{
    command.addOption (
        option,
        [target = options, option, si_unit, example, take] (const std::string& text) {
            take (target->settings, readSignedAmount (option, text, si_unit, example));
        },
        about);
}

FitCommand addFitKind (const Command& fit, FitKind kind, const std::string& about, const std::string& footer)
{
    const auto& info = infoOf (kind);
    const FitCommand made { fit.add (info.id, about), std::make_shared<FitCommandOptions>() };
    const auto& options = made.options;
    std::string columns, roles;
    for (const auto& column : info.columns)
    {
        columns +=
            (columns.empty() ? "" : ", ") + column.role + (column.unit.empty() ? "" : " (" + column.unit + ")") + (column.required ? "" : " if recorded");
        addToList (roles, column.role);
    }
    const auto recorded = "CSV file with the columns " + columns + ", in order of time; or a WAV with the columns t and \"channel 1\", \"channel 2\" …";
    made.command.addOption ("recording", options->recording, recorded).required();
    made.command.addOption ("-o,--out", options->preset, "The preset to write: a graph file").required();
    made.command.addOption ("--plot", options->plot, "Plot the recording and the fit into this PNG, SVG or PDF file");
    made.command.addFlag ("--json", options->json, "Print JSON, for use by programs");
    made.command
        .addOption ("--column", options->columns,
                    "The name of the column for a role, such as --column \"force=Fx\"; without a name: not recorded. Roles: " + roles)
        .oneValueEach();
    made.command
        .addOption ("--unit", options->units,
                    "What 1 in a column means, such as --unit \"force=1 mN\"; default: as in the name of the column (x_um, \"Force [mN]\"), or SI")
        .oneValueEach();
    if (std::ranges::any_of (info.columns, &FitColumn::is_positive))
        made.command
            .addOption ("--sign", options->signs,
                        "Turn the sign of a column, such as --sign \"depth=-\", or keep it: --sign \"depth=+\"; default: as the recording suggests")
            .oneValueEach();
    if (std::ranges::any_of (info.columns, [] (const FitColumn& column) { return column.role == "t"; }))
        made.command.addOption ("--rate", options->settings.rate, "Rows per second, if the recording has no column of times").check (finiteWithin (0.01, 1e7));
    made.command.footer (footer);
    made.command.callback ([options, kind] { runFit (kind, *options); });
    return made;
}

}   // namespace tactus::host
