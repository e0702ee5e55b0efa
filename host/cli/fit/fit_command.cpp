// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/cli/amount.hpp>
#include <host/cli/overwriting.hpp>
#include <host/cli/report.hpp>
#include <host/tools/figures/plot.hpp>
#include <host/tools/fitting/fit_options.hpp>
#include <host/tools/fitting/recording_file.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

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
        std::cout << host::jsonOf (made, options.recording, options.preset).dump (2) << "\n";
        return;
    }
    std::cout << printableName (options.recording) << ": " << made.report.rows << " rows, " << info.about << "\n"
              << host::textOf (made.report);
    for (const auto* lines : { &made.details, &made.snippets })
        for (const auto& line : *lines)
            std::cout << "  " << line << "\n";
    std::cout << "wrote " << printableName (options.preset) << "\n";
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
    FileAssets assets;
    orFail (checkFitted (made, options.recording, assets));
    orFail (saveGraph (made.preset, options.preset));
    if (! options.plot.empty()) drawFit (made.report.picture, std::filesystem::path (options.recording).filename().string(), options.plot);
    printFit (made, options);
    for (const auto& warning : made.warnings)
        warn (options.recording, warning);
}
}   // namespace

void FitCommand::add (const std::string& name, const std::string& example, const std::string& about) const
{
    const auto* row = findFitOption (kind, name);
    const auto option = "--" + name;
    if (example.empty())
    {
        const auto added = command.addOption (
            option, [target = options, row] (const std::string& text) { row->set (target->settings, wholeNumber (text).value_or (0.0)); }, about);
        if (row->is_whole)
            added.check (within (static_cast<int> (row->least), static_cast<int> (row->most)));
        else
            added.check (finiteWithin (row->least, row->most));
        return;
    }
    command.addOption (
        option,
        [target = options, row, option, example] (const std::string& text) {
            row->set (target->settings,
                      row->least < 0.0 ? readSignedAmount (option, text, row->unit, example.c_str()) : readAmount (option, text, row->unit, example.c_str()));
        },
        about);
}

FitCommand addFitKind (const Command& fit, FitKind kind, const std::string& about, const std::string& footer)
{
    const auto& info = infoOf (kind);
    const FitCommand made { kind, fit.add (info.id, about), std::make_shared<FitCommandOptions>() };
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
        made.add ("rate", "", "Rows per second, if the recording has no column of times");
    made.command.footer (footer);
    made.command.callback ([options, kind] { runFit (kind, *options); });
    return made;
}

}   // namespace tactus::host
