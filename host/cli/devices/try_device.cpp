// SPDX-License-Identifier: GPL-3.0-or-later
#include "try_device.hpp"

#include <host/base/platform/home_folder.hpp>
#include <host/base/platform/line_input.hpp>
#include <host/base/platform/signals.hpp>
#include <host/cli/report.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/hid_link/profile_library.hpp>
#include <host/devices/live/hardware.hpp>
#include <host/devices/sessions/numbers_device.hpp>
#include <host/devices/sessions/offered_devices.hpp>
#include <host/devices/sessions/session_file.hpp>
#include <host/devices/trial/trial.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/text/quote.hpp>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <utility>

namespace tactus::host
{

namespace
{
/// The person at this terminal. A line is an answer, or a stop while something pushes.
class TerminalPerson final : public TrialPerson
{
public:
    void tell (const std::string& text) override { std::cout << "    " << printable (text) << '\n'
                                                             << std::flush; }

    std::optional<std::string> ask (const std::string& question) override
    {
        std::cout << question << "\n> " << std::flush;
        while (! stopRequested() && ! lines.hasEnded())
            if (auto line = lines.next (50)) return line;
        return std::nullopt;
    }

    bool wantsStop() override { return lines.next (0).has_value() || lines.hasEnded(); }

private:
    LineInput lines;
};

struct Chosen
{
    Json description;
    std::filesystem::path folder;
};

Chosen choose (const std::string& what, const hid::LoadedProfiles& profiles)
{
    const auto session = loadDefaultSession (homeFolder());
    if (const auto* bound = session.session.binding (what)) return { *bound, session.file.parent_path() };
    return { orFail (readAddress (what, profiles)), {} };
}

std::atomic<TrialRun*> under_signal { nullptr };   // that SIGUSR1 stops

TrialSetting::Way bySignal()
{
    return { "the signal SIGUSR1", [] (TrialRun& run) {
                under_signal = &run;
                watchForEmergency ([]() noexcept { under_signal.load()->emergencyStop(); }, []() noexcept {});
#if defined(SIGUSR1)
                std::raise (SIGUSR1);
#else
                run.emergencyStop();   // a system without this signal
#endif
                watchForEmergency (nullptr, nullptr);
            } };
}
}   // namespace

void tryOnDevice (const std::string& what, const std::string& report)
{
    const std::string file = report.empty() ? "trial.json" : report;
    if (std::filesystem::exists (file)) fail ("output/exists", file + ": this file exists, and a report cannot be repeated", "name another file with --out");
    watchForStop();
    const auto profiles = hid::loadProfileLibrary();
    const auto chosen = choose (what, profiles);
    Hardware hardware { hid::thisComputer(), [&profiles]() -> const hid::LoadedProfiles& { return profiles; }, nullptr };
    TrialSetting setting { .ways = { bySignal() } };
    const auto plan = compile (readGraph (TrialGraph {}.text (setting.run.rate_hz)).graph, catalogue()).plan;
    auto made = hardware.open (chosen.description, chosen.folder, "tool", *plan);
    std::string remarks;
    for (const auto& m : made.messages)
        if (m.severity == Message::Severity::error)
            fail (m);
        else
        {
            warn (what, m);
            remarks += (remarks.empty() ? "" : "; ") + m.text;
        }
    setting.run.stop_wanted = stopRequested;
    const auto driver = chosen.description.value ("driver", std::string());
    setting.tried = Json { { "device", what }, { "driver", driver }, { "about", made.about }, { "remarks", remarks }, { "program", TACTUS_VERSION } };
    std::cout << printable (made.about)
              << "\nForces are at most 0.3 N, and 1 N at walls. Enter stops whatever pushes; Ctrl-C ends the trial. Have a switch for the "
              << "supply of the device at hand.\n";
    TerminalPerson person;
    const auto result = tryDevice (*made.device, made.limits, setting, person);
    made.device.reset();
    orFail (writeTextFile (file, result.dump (1) + "\n"));
    std::cout << "wrote " << printableName (file) << "; docs/known_devices.md says how to send it\n";
    for (const auto& step : result.at ("steps"))
        if (step.at ("verdict") == Json ("differs")) throw Stop {};
}

}   // namespace tactus::host
