// SPDX-License-Identifier: MIT
#include <tactus/file/csv.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/run/log/content_hash.hpp>
#include <tactus/run/log/run_log_reader.hpp>

#include "support/temporary_folder.hpp"
#include "support/with_limits.hpp"

#include <catch2/catch.hpp>

#if ! defined(_WIN32)
#include <sys/stat.h>
#endif

using namespace tactus;
using Catch::Matchers::Contains;

TEST_CASE ("a file that fits the budgets is read as it is", "[file]")
{
    const TemporaryFolder folder;
    folder.write ("a", std::string ("a\0\r\n", 4));
    CHECK (*readFile (folder / "a") == std::string ("a\0\r\n", 4));
    CHECK (whyUnreadable (folder / "a").empty());
}

TEST_CASE ("a file over the budget is refused, and so is the file with which all files exceed theirs", "[file]")
{
    const TemporaryFolder folder;
    folder.write ("small", std::string (60, 'a'));
    folder.write ("large", std::string (101, 'a'));
    const WithLimits limits ("file=100,reading=150");
    beginReading();
    CHECK_THAT (readFile (folder / "large").error().remedy, Contains ("--limits file="));
    beginReading();
    CHECK (readFile (folder / "small"));
    CHECK (readFile (folder / "small"));
    CHECK_THAT (readFile (folder / "small").error().remedy, Contains ("--limits reading="));
    beginReading();
    CHECK (readFile (folder / "small"));
}

TEST_CASE ("included files count toward one budget of values, and their number is limited", "[file]")
{
    const TemporaryFolder folder;
    folder.write ("part.json", R"({ "format": "tactus-graph", "version": 1, "ui": { "a": [1, 2, 3] } })");
    folder.write ("other.json", R"({ "format": "tactus-graph", "version": 1, "ui": { "a": [1, 2, 3] } })");
    folder.write ("main.json", R"({ "format": "tactus-graph", "version": 1, 
      "nodes": { "a": { "type": "file:part.json" }, "b": { "type": "file:other.json" } } })");
    CHECK_FALSE (hasErrors (loadGraph (folder / "main.json").messages));   // 8 values in each file
    const auto idWith = [&] (const char* limits) {
        const WithLimits changed (limits);
        const auto messages = loadGraph (folder / "main.json").messages;
        REQUIRE_FALSE (messages.empty());
        return messages.front().id;
    };
    CHECK (idWith ("values=20") == "file/too_large");
    CHECK (idWith ("files=1") == "file/too_many");
}

#if ! defined(_WIN32)
TEST_CASE ("no reader opens a named pipe, a device or a folder", "[file]")
{
    const TemporaryFolder folder;
    const auto pipe = folder / "pipe";
    REQUIRE (::mkfifo (pipe.c_str(), 0600) == 0);
    CHECK_THAT (whyUnreadable (pipe), Contains ("named pipe"));
    CHECK_THAT (whyUnreadable ("/dev/zero"), Contains ("a device"));
    CHECK_THAT (whyUnreadable (folder.path()), Contains ("a folder"));
    CHECK_THAT (whyUnreadable (folder / "none"), Contains ("No such file"));
    for (const auto& path : { pipe, std::filesystem::path ("/dev/zero"), folder.path() })
    {
        INFO (path.string());
        CHECK (readFile (path).error().id == "file/unreadable");
        CHECK_FALSE (readTextFile (path));
        CHECK (readTable (path).error().id == "csv/unreadable");
        CHECK (loadGraph (path).messages.at (0).id == "file/unreadable");
        CHECK (RunLogReader::open (path.string()).error().id == "file/unreadable");
        CHECK_FALSE (fileHash (path));
    }
}
#endif
