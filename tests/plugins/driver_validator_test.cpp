// SPDX-License-Identifier: MIT
// `tactus check-plugin` catches device drivers that lie.
#include "load.hpp"
#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <host/cli/program.hpp>
#include <tactus/text/json.hpp>

#include <cstdlib>
#include <fstream>
#include <sstream>

using namespace tactus;

namespace
{
/// Checks a driver. `device`: how the device lies; "": none is opened.
test::Ran check (const std::string& driver, const std::string& device = {}, std::vector<std::string> more = { "--strict", "1" })
{
    std::vector<std::string> words { "check-plugin", test::driverFile (driver).string(), "--json" };
    if (! device.empty()) words.insert (words.end(), { "--open", Json { { "port", device } }.dump() });
    words.insert (words.end(), more.begin(), more.end());
    return test::runTactus (words);
}

/// A line "id: why" for each examination with this result.
std::string linesOf (const test::Ran& ran, const std::string& result)
{
    std::string all;
    const auto report = Json::tryParse (ran.out);
    INFO (ran.out + ran.err);
    REQUIRE (report);
    for (const auto& e : report->at ("examinations"))
        if (e["result"] == result) all += e["id"].get<std::string>() + ": " + e.value ("why", "") + "\n";
    return all;
}

/// Checks that the driver fails, and that the failures contain these words.
void catches (const std::string& driver, const std::string& device, const std::vector<std::string>& words)
{
    CAPTURE (driver, device);
    const auto ran = check (driver, device);
    CHECK (ran.status == 1);
    const auto failures = linesOf (ran, "FAIL");
    INFO (failures);
    for (const auto& word : words)
        CHECK (failures.find (word) != std::string::npos);
}
}   // namespace

TEST_CASE ("check-plugin passes an honest driver, and opens a device only if it is told to", "[plugins]")
{
    const TemporaryFolder folder;
    const auto log = (folder / "log").string();
    const auto device = Json { { "port", "honest" }, { "log", log }, { "about", "Tactus reads this itself." } }.dump();
    const auto ran = test::runTactus ({ "check-plugin", test::driverFile ("lying").string(), "--json", "--strict", "3", "--open", device });
    CHECK (linesOf (ran, "FAIL") == "");
    CHECK (linesOf (ran, "SKIPPED") == "");
    CHECK (ran.status == 0);
    const auto report = Json::parse (ran.out);
    CHECK (report["kind"] == "driver");
    CHECK (report["name"] == "lying");
    CHECK (report["abi"] == 1);
    CHECK (report["nodes"].empty());

    // The device got no force, and each time it was opened, it came to rest at first.
    std::ifstream in (log);
    std::string line, before = "close";
    int forces = 0, rests = 0;
    while (std::getline (in, line))
    {
        CHECK ((line == "force 0" || line == "rest" || line == "close"));
        if (before == "close") CHECK (line == "rest");
        forces += line == "force 0" ? 1 : 0;
        rests += line == "rest" ? 1 : 0;
        before = line;
    }
    CHECK (forces > 100);
    CHECK (rests > 30);

    const auto closed = check ("lying");
    CHECK (closed.status == 0);
    CHECK (linesOf (closed, "SKIPPED").find ("readings: no device is given") != std::string::npos);
    CHECK (check ("serial_arm").status == 0);
}

TEST_CASE ("check-plugin names what keeps a driver from being loaded", "[plugins]")
{
    catches ("bad_abi", "", { "plugin/wrong_abi", "version 99" });
    catches ("bad_size", "", { "plugin/wrong_size" });
    catches ("bad_rest", "", { "plugin/bad_driver", "only one of write and rest" });
    catches ("bad_key", "", { "plugin/bad_driver", "cannot have a key 'guard'" });
    catches ("misnamed", "", { "plugin/bad_driver", "its file must be lying.tactus-device" });
    catches ("bad_no_entry", "", { "plugin/no_entry" });
}

TEST_CASE ("check-plugin catches a driver that crashes, or refuses without a reason", "[plugins]")
{
    catches ("bad_check", "", { "descriptions: `check` does not say why it refuses" });
    catches ("bad_crash", "", { "port: `open`: the program was ended by signal 11" });
}

TEST_CASE ("check-plugin catches a driver that describes its device wrongly", "[plugins][safety]")
{
    catches ("lying", "no_limits", { "open: ", "gives no max_force", "device/no_limits" });
    catches ("lying", "no_failsafe", { "open: ", "device/no_failsafe" });
    catches ("lying", "late_failsafe", { "open: ", "device/no_failsafe" });
    catches ("lying", "unstamped", { "open: ", "a frozen reading would not be noticed", "gives no max_still with still_force", "device/no_limits" });
    catches ("lying", "no_json", { "open: ", "device/bad_driver" });
    catches ("lying", "many", { "open: ", "gives 40 axes" });
    catches ("lying", "twins", { "open: ", "two of its axes 'twist'" });
    catches ("lying", "no_file", { "open: ", "device/bad_driver" });
    catches ("lying", "changes", { "again: it has other parts or limits when it is opened again" });
    catches ("lying", "leaks", { "again: each time it is opened and closed, a file stays open" });
    catches ("lying", "runs_on", { "again: a thread of it runs on after `close`" });
    catches ("lying", "past_about", { "bounds: `open` writes past the end of tactus_device_about" });
}

TEST_CASE ("check-plugin catches a driver whose readings lie", "[plugins][safety]")
{
    catches ("lying", "nan", { "readings: a reading is not a number" });
    catches ("lying", "few", { "readings: a reading has 1 axes, but it names 2" });
    catches ("lying", "old", { "readings: a reading has an age of -1 s" });
    catches ("lying", "not_homed", { "readings: no reading is valid" });
    catches ("lying", "spins", { "readings: `read` returns at once, again and again" });
    catches ("lying", "fast", { "readings: ", "but its rate is 100 per s" });
    catches ("lying", "repeats", { "readings: most readings have the number or the time of the one before" });
    catches ("lying", "batches", { "readings: most readings cannot be used, because others are missing before them" });
    catches ("lying", "back", { "readings: the number or the time of a reading went back" });
    catches ("lying", "no_number", { "readings: a reading lacks the number or the time that the driver promises for every one" });
    catches ("lying", "gone", { "readings: the device is gone: nobody is there" });
    catches ("lying", "past_end", { "bounds: `read` writes past the end of tactus_reading" });
    catches ("lying", "fails", { "timeout: `read` fails and does not say why" });
}

TEST_CASE ("check-plugin catches a driver that does not keep the times", "[plugins][safety]")
{
    catches ("lying", "early", { "timeout: `read` returns without a reading long before the 10 ms have passed" });
    catches ("lying", "late", { "timeout: `read` takes at least " });
    catches ("lying", "slow", { "rest: `write` usually takes 1" });
    catches ("lying", "slow_rest", { "rest: `rest` usually takes " });
    catches ("lying", "blocks", { "threads: `write` usually takes " });
}

TEST_CASE ("check-plugin catches a driver that does not come to rest", "[plugins][safety]")
{
    catches ("lying", "refuses", { "rest: `write` fails: no" });
    catches ("lying", "mute", { "rest: `write` fails and does not say why" });
    catches ("lying", "dead", { "rest: `write` fails: no; then `rest` fails: it is stuck" });
    catches ("lying", "no_rest", { "rest: `rest` fails: it is stuck" });
}

TEST_CASE ("check-plugin catches a driver whose list of devices is wrong", "[plugins]")
{
    const auto [lie, why] = GENERATE (table<const char*, const char*> ({
        { "mute", "find: `find` fails and does not say why" },
        { "answer", "find: `find` returns 2" },
        { "crash", "find: `find`: the program was ended by signal 11" },
        { "null", "find: device 0: it is NULL" },
        { "size", "find: device 0: its size is 4" },
        { "no_port", "find: device 0: its port is NULL" },
        { "no_name", "find: device 0: its name is NULL" },
        { "empty_name", "find: device 0: it has no name" },
        { "state", "find: device 0: its state is 64" },
        { "bytes", "has characters that cannot be printed" },
        { "endless", "find: device 0: its port has no end within 1000 bytes" },
        { "twice", "find: device 1: its port 'honest' came before" },
        { "many", "find: it finds more than 1000 devices" },
        { "changes", "find: the second call of `find` finds other devices than the first one" },
        { "later", "find: it adds a device after `find` has returned" },
        { "refused", "find: `check` refuses the port '50%' that `find` has found" },
    }));
    ::setenv ("LYING_FIND", lie, 1);
    catches ("lying", "honest", { why });
    ::setenv ("LYING_FIND", "away", 1);   // it cannot look here, and says why
    CHECK (check ("lying", "honest").status == 0);
    ::unsetenv ("LYING_FIND");
}

TEST_CASE ("check-plugin ends a read that never returns, and names it", "[plugins][safety]")
{
    const auto ran = check ("lying", "hangs");
    CHECK (ran.status == 1);
    CHECK (linesOf (ran, "FAIL") == "bounds: `read`: does not return within 20 s\n");
    CHECK (linesOf (ran, "SKIPPED").find ("timeout: the driver did not return in `bounds`") != std::string::npos);
}

TEST_CASE ("check-plugin does not take text for a description", "[plugins]")
{
    for (const char* text : { "/dev/ttyACM0", "[]", "{" })
        CHECK (test::runTactus ({ "check-plugin", test::driverFile ("lying").string(), "--open", text }).status == 2);
}
