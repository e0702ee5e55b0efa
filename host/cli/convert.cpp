// SPDX-License-Identifier: GPL-3.0-or-later
#include "amount.hpp"
#include "commands.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <host/tools/reports/conversion.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <iostream>
#include <memory>

namespace tactus::host
{

namespace
{
/// Prints a warning with its place and its remedy.
void say (const Message& m)
{
    std::cerr << inOneLine (m.where) << ": warning: " << inOneLine (m.text) << "\n    " << inOneLine (m.remedy) << " [" << m.id << "]\n";
}

/// Prints how far each written file is from the one that was read. Always prints something, even if nothing was lost.
void run (const ConversionOptions& options)
{
    const auto made = convert (options);
    for (const auto& m : made.notes)
        say (m);
    if (made.is_pen)
        std::cout << printableName (options.in) << ": " << made.rows << " rows, " << roundedText (made.seconds, 3) << " s\n";
    else
        std::cout << printableName (options.in) << ": " << made.tracks << (made.tracks == 1 ? " track, " : " tracks, ") << made.events
                  << " points and transients, " << roundedText (made.seconds, 3) << " s\n";
    for (const auto& file : made.files)
    {
        std::cout << "wrote " << printableName (file.name) << "\n";
        for (std::size_t i = file.said; i < file.losses.size(); ++i)
            say (file.losses[i]);   // the notes of the reader were said when it was read
        for (const auto& m : file.losses)
            std::cout << "  loss: " << inOneLine (m.where) << ": " << inOneLine (m.text) << "\n";
        for (const auto& sentence : file.differences)
            std::cout << "  loss: " << sentence << "\n";
    }
}
}   // namespace

void addConvert (const Command& app)
{
    const auto options = std::make_shared<ConversionOptions>();
    const auto command = app.add ("convert", "Convert a haptic clip (AHAP, .haptic, HJIF, WAV, CSV, clips of Tactus), or a pen recording to a trace");
    command.addOption ("in", options->in, "The file to read: .haptic, .ahap, .hjif, .json, .wav or .csv; or a pen recording, .events or .evemu")
        .required();
    command.addOption ("out", options->out, "The file to write; its extension selects the format").required();
    command.addOption ("--calibration", options->calibration, "What 0 and 1 mean on the device: an actuator calibration file of Meta (.acf)");
    command
        .addOption ("--rate", options->rate_hz,
                    "Samples per second of a .wav, by default 8000 or those of the recording; of a .csv, instead of rows of the clip; "
                    "or of a trace, by default 1000")
        .check (finiteWithin (1.0, 1e6));
    command.addFlag ("--split", options->split, "Write continuous events and transients into two .ahap files, OUT and OUT_transients");
    const auto addPenAmount = [&] (const std::string& option, const char* si_unit, const char* example, auto field, const char* about) {
        command.addOption (
            option,
            [options, option, si_unit, example, field] (const std::string& text) {
                options->pen.*field = readAmount (option, text, si_unit, example);
                options->pen_option = option;
            },
            about);
    };
    addPenAmount ("--pitch", "m", "5 um", &EvemuOptions::pitch, "Pen: length of one unit of the tablet; default: as recorded, else 5 um");
    addPenAmount ("--force", "N", "3 N", &EvemuOptions::full_force, "Pen: force at full pressure; default 3 N");
    addPenAmount ("--depth", "m", "2 mm", &EvemuOptions::full_depth, "Pen: depth below the surface at full pressure; default 2 mm");
    addPenAmount ("--lift", "m", "5 mm", &EvemuOptions::lift, "Pen: height above the surface while the pen is up; default 5 mm");
    addPenAmount ("--full-pressure", "", "2047", &EvemuOptions::full_pressure, "Pen: units at full pressure; default: as recorded, else 2047");
    addLimits (command);
    command.footer ("Prints the parts that the format cannot hold, and the rms difference of the rendered envelope. See docs/clips.md.\n\n"
                    "Examples:\n"
                    "  tactus convert effect.haptic effect.ahap\n"
                    "  tactus convert effect.haptic effect.json --calibration MetaQuest.acf\n"
                    "  tactus convert effect.ahap effect.wav --rate 48000\n"
                    "  tactus convert pen.events pen.csv --force \"2 N\"");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
