// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "overwriting.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/base/files/stretch_files.hpp>
#include <host/tools/fitting/surface_preset.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/run/log/run_test.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

namespace tactus::host
{

namespace
{
struct CaptureOptions
{
    std::string log, clip, gesture, test, role;
    std::vector<std::string> records;
    double from_s = 0.0, until_s = 0.0;   // until_s: 0 for the end of the run
};

void printAll (const Messages& messages, const std::string& file)
{
    for (const auto& m : messages)
        warn (m.where.empty() ? file : m.where, m);
}

/// The role that moves the hand: the one that was named, or the first one.
std::string roleIn (const CaptureOptions& options, StretchReader::Options how)
{
    if (options.gesture.empty() || ! options.role.empty()) return options.role;
    how.role.clear();
    const auto reader = orFail (StretchReader::open (options.log, std::move (how)));
    if (const auto role = reader->firstRole(); ! role.empty()) return role;
    fail ("take/no_movement", "the run has no role, so there is no hand to capture", "log a run whose graph uses a device");
}

void writeClip (const CaptureOptions& options, const Stretch& stretch)
{
    Messages notes;
    const auto clip = clipOfStretch (stretch, notes);
    const auto saved = orFail (saveClip (clip, options.clip));
    std::cout << "wrote " << printableName (options.clip) << ": a clip of " << stretch.names.size()
              << (stretch.names.size() == 1 ? " channel\n" : " channels\n");
    printAll (notes, options.clip);
    printAll (saved.losses, options.clip);
    for (const auto& sentence : differenceReport (saved))
        std::cout << "  loss: " << sentence << "\n";
}

void writeGesture (const CaptureOptions& options, const Stretch& stretch, const std::string& role)
{
    orFail (saveMovement (stretch, options.gesture));
    std::cout << "wrote " << printableName (options.gesture) << ": the movement of " << printableName (role) << "; play it with --device "
              << printableName (role) << "=trace:" << printableName (options.gesture) << "\n";
}

void writeTest (const CaptureOptions& options, const Stretch& stretch)
{
    orFail (writeRunTest (options.log, options.test, stretch, options.records, TACTUS_VERSION));
    std::cout << "wrote " << printableName (options.test) << ": a test of " << stretch.ticks() << " ticks and " << stretch.names.size() << " values each";
    if (stretch.from > 0)
        std::cout << "; it replays the run from its start, because the state of the nodes is known only there, and compares from "
                  << roundedText (static_cast<double> (stretch.from) / stretch.rate_hz, 3) << " s on";
    std::cout << "\n";
}

void run (const CaptureOptions& options)
{
    std::vector<std::string> outputs { options.clip, options.gesture, options.test };
    std::erase (outputs, "");
    if (outputs.empty()) throw UsageError ("--clip, --gesture or --test is required");
    if (! options.clip.empty() && options.records.empty()) throw UsageError ("--clip", "--record PORT says what the clip plays");
    if (options.until_s != 0.0 && options.until_s <= options.from_s) throw UsageError ("--until", "the end of the stretch must be after its start");
    refuseOverwriting (outputs, { options.log });

    FileAssets assets;
    StretchReader::Options how { .from_s = options.from_s,
                                 .records = options.records,
                                 .assets = &assets,
                                 .services = { .nearest_triangle = nearestByBoxes },
                                 .program = TACTUS_VERSION };
    if (options.until_s > 0.0) how.until_s = options.until_s;
    how.role = roleIn (options, how);
    Messages warnings;
    const auto stretch = orFail (readStretch (options.log, how, warnings));
    printAll (warnings, options.log);
    if (! options.clip.empty()) writeClip (options, stretch);
    if (! options.gesture.empty()) writeGesture (options, stretch, how.role);
    if (! options.test.empty()) writeTest (options, stretch);
}
}   // namespace

void addCapture (const Command& app)
{
    const auto options = std::make_shared<CaptureOptions>();
    const auto command = app.add ("capture", "Make a clip, a gesture or a test from a stretch of a logged run");
    command.addOption ("log", options->log, "The log that `tactus play --log` wrote").required();
    command.addOption ("--from", options->from_s, "Start of the stretch in s; default: the start of the run").check (finiteWithin (0.0, 1e9));
    command.addOption ("--until", options->until_s, "End of the stretch in s; default: the end of the run").check (finiteWithin (1e-9, 1e9));
    command.addOption ("--record", options->records, "Ports of the clip or the test, separated by commas; default for a test: the inputs of every sink")
        .separatedBy (',')
        .oneValueEach();
    command.addOption ("--clip", options->clip, "Write the ports as a clip; the extension selects the format: .json, .haptic, .ahap, .hjif, .wav or .csv");
    command.addOption ("--gesture", options->gesture, "Write the movement of a hand as a .csv, which --device ROLE=trace:FILE.csv plays");
    command.addOption ("--role", options->role, "The role that moved the hand; default: the first one");
    command.addOption ("--test", options->test, "Write a test for `tactus test`: the run, and the expected values of the ports, bit for bit");
    addLimits (command);
    addPlugins (command);
    command.footer ("A test always replays the run from its start, because the state of the nodes is known only there. See docs/replay.md.\n\n"
                    "Examples:\n"
                    "  tactus play graphs/dry_wood.json --log wood.jsonl\n"
                    "  tactus capture wood.jsonl --from 1 --until 1.5 --record drag.force.x --clip scrape.haptic\n"
                    "  tactus capture wood.jsonl --gesture pen.csv\n"
                    "  tactus capture wood.jsonl --from 1 --until 2 --test wood_test.jsonl");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
