// SPDX-License-Identifier: MIT
#include "fused_plans.hpp"
#include "support/waiting.hpp"

#include <host/code/fuse/bitcode.hpp>
#include <host/code/fuse/fuser.hpp>
#include <support/other_user.hpp>
#include <support/sketch.hpp>
#include <support/temporary_folder.hpp>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

using namespace tactus;
using host::Fuser;

namespace
{
namespace fs = std::filesystem;

std::shared_ptr<Plan> smallPlan (double cutoff_hz = 20.0)
{
    const auto sketch = test::Sketch {}.node ("a", "filter.one_pole", { { "cutoff", cutoff_hz } }).node ("b", "filter.one_pole").wire ("a.out -> b.in");
    return sketch.compile ({ .feeds = { "a.in" }, .records = { "b.out" } }).plan;
}

/// The outputs of some ticks with an input that changes.
std::vector<double> outputs (Plan& plan, int ticks)
{
    std::vector<double> all;
    for (int k = 0; k < ticks; ++k)
    {
        plan.feeds()[0] = k % 5 - 2.0;
        plan.beginTick (static_cast<std::uint64_t> (k));
        plan.tick();
        all.push_back (*plan.taps()[0].value);
    }
    return all;
}

/// A program that takes the place of the compiler, and one that takes that of tactus-fuse-llvm.
class FakeCompiler
{
public:
    explicit FakeCompiler (const std::string& script, const std::string& llvm = {})
    {
        write ("compiler", "echo run >> '" + (folder / "runs").string() + "'\n" + script);
        write ("llvm", llvm);
        how = { .compiler = { .compiler = (folder / "compiler").string(), .llvm = (folder / "llvm").string(), .cache = folder / "cache" },
                .uses_llvm = ! llvm.empty() };
    }

    const Fuser::Options& options() const { return how; }
    const fs::path& cache() const { return how.compiler.cache; }

    int runs() const
    {
        std::ifstream in (folder / "runs");
        int n = 0;
        for (std::string line; std::getline (in, line);)
            ++n;
        return n;
    }

private:
    void write (const std::string& name, const std::string& script)
    {
        folder.write (name, "#!/bin/sh\n" + script + "\n");
        fs::permissions (folder / name, fs::perms::owner_all);
    }

    TemporaryFolder folder;
    Fuser::Options how;
};

/// Looks again and again until the fuser has finished.
std::optional<Message> finish (Fuser& fuser, const std::shared_ptr<Plan>& plan, double now_s)
{
    std::optional<Message> message;
    REQUIRE (test::eventually (std::chrono::milliseconds (5), test::looks_at_compiler, [&] { return (message = fuser.poll (plan, now_s)) || fuser.state() != Fuser::State::compiles; }));
    return message;
}

/// A compiler that puts this file where the output belongs.
std::string copies (const std::string& object) { return "while [ $# -gt 1 ]; do [ \"$1\" = -o ] && cp '" + object + "' \"$2\"; shift; done"; }
}   // namespace

TEST_CASE ("a plan runs on by its records if the compiler fails, is killed, or makes nonsense", "[fuse]")
{
    const auto script = GENERATE (as<std::string> {}, "echo 'error: no' >&2; exit 1", "kill -9 $$", "exit 0", copies ("/etc/passwd"));
    INFO (script);
    const FakeCompiler compiler { script };
    Fuser fuser { compiler.options() };
    const auto plan = smallPlan(), other = smallPlan();
    const auto said = finish (fuser, plan, 0.0);
    REQUIRE (said);
    CHECK (said->severity == Message::Severity::warning);
    CHECK (said->text.find ("not fused") != std::string::npos);
    CHECK (fuser.state() == Fuser::State::fails);
    CHECK (fuser.describe() == "plan");
    CHECK_FALSE (plan->isFused());
    CHECK_FALSE (fuser.poll (plan, 100.0));   // says it once, and does not try again
    CHECK (compiler.runs() == 1);
    CHECK (outputs (*plan, 50) == outputs (*other, 50));
}

TEST_CASE ("a compiler that hangs is ended, and the plan runs on by its records", "[fuse]")
{
    const FakeCompiler compiler { "while true; do sleep 1; done" };
    Fuser fuser { compiler.options() };
    const auto plan = smallPlan();
    CHECK_FALSE (fuser.poll (plan, 0.0));
    CHECK (fuser.state() == Fuser::State::compiles);
    CHECK (fuser.describe() == "plan, fusing");
    CHECK_FALSE (fuser.poll (plan, 299.0));
    const auto said = fuser.poll (plan, 301.0);
    REQUIRE (said);
    CHECK (said->id == "fuse/too_long");
    CHECK (fuser.state() == Fuser::State::fails);
    CHECK_FALSE (plan->isFused());
}

TEST_CASE ("without a compiler, no plan is fused, and this is said once", "[fuse]")
{
    Fuser fuser { { .compiler = { .compiler = "/no/such/compiler", .llvm = "/no/such/program" } } };
    const auto plan = smallPlan(), next = smallPlan();
    const auto said = fuser.poll (plan, 0.0);
    REQUIRE (said);
    CHECK (said->id == "fuse/no_compiler");
    CHECK_FALSE (fuser.poll (next, 1.0));
    CHECK_FALSE (fuser.poll (next, 100.0));
    CHECK (fuser.state() == Fuser::State::fails);
}

TEST_CASE ("an edited plan runs by its records until there have been no edits for a while, and a known shape is not compiled again", "[fuse]")
{
    const auto first = smallPlan();
    const FakeCompiler compiler { copies (test::compiledFusion (host::FusedCode::of (*first))) };
    Fuser fuser { compiler.options() };
    REQUIRE_FALSE (finish (fuser, first, 0.0));
    CHECK (fuser.state() == Fuser::State::fused);
    CHECK (fuser.describe() == "fused");
    CHECK (first->isFused());
    CHECK (compiler.runs() == 1);

    const auto edited = smallPlan (30.0), again = smallPlan (40.0), compared = smallPlan (40.0);
    CHECK_FALSE (fuser.poll (edited, 10.0));
    CHECK (fuser.state() == Fuser::State::rests);
    CHECK_FALSE (fuser.poll (edited, 10.4));
    CHECK_FALSE (fuser.poll (again, 10.45));   // the rest begins again
    CHECK_FALSE (fuser.poll (again, 10.9));
    CHECK (fuser.state() == Fuser::State::rests);
    CHECK_FALSE (edited->isFused());
    CHECK_FALSE (again->isFused());
    CHECK_FALSE (finish (fuser, again, 10.96));
    CHECK_FALSE (finish (fuser, again, 10.96));
    CHECK (again->isFused());
    CHECK (compiler.runs() == 1);   // the code is the same: a parameter is not part of it
    CHECK (outputs (*again, 50) == outputs (*compared, 50));
}

TEST_CASE ("code that another user could have put into the cache is not loaded", "[fuse]")
{
    const auto foreign = GENERATE (as<std::string> {}, "writable folder", "writable folder above", "writable file", "link", "folder", "folder above", "file");
    INFO (foreign);
    const auto first = smallPlan();
    const FakeCompiler compiler { copies (test::compiledFusion (host::FusedCode::of (*first))) };
    const auto above = compiler.cache().parent_path();
    REQUIRE_FALSE (finish (*std::make_unique<Fuser> (compiler.options()), first, 0.0));
    REQUIRE (compiler.runs() == 1);
    const auto kept = fs::directory_iterator (compiler.cache())->path();
    REQUIRE (kept.extension() == ".so");
    CHECK (fs::status (kept).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
    fs::remove (kept);                                // it is loaded, so it must not be written to
    std::ofstream (kept) << "code of another user";   // loading it would fail

    if (foreign == "writable folder") fs::permissions (compiler.cache(), fs::perms::all);
    if (foreign == "writable folder above") fs::permissions (above, fs::perms::all);
    if (foreign == "writable file") fs::permissions (kept, fs::perms::all);
    if (foreign == "link")
    {
        fs::rename (kept, above / "elsewhere.so");
        fs::create_symlink (above / "elsewhere.so", kept);
    }
    if (foreign == "folder" && ! test::giveAway (compiler.cache())) return;
    if (foreign == "folder above" && ! test::giveAway (above)) return;
    if (foreign == "file" && ! test::giveAway (kept)) return;

    Fuser fuser { compiler.options() };
    const auto plan = smallPlan();
    if (foreign.find ("folder") != std::string::npos)
    {
        const auto said = fuser.poll (plan, 0.0);
        REQUIRE (said);
        CHECK (said->id == "fuse/cache");
        CHECK (said->severity == Message::Severity::warning);
        CHECK_FALSE (said->remedy.empty());
    }
    CHECK_FALSE (finish (fuser, plan, 0.0));
    CHECK (fuser.state() == Fuser::State::fused);   // by the compiler
    CHECK (compiler.runs() == 2);
    fs::permissions (above, fs::perms::owner_all);
}

TEST_CASE ("if LLVM fails, is killed, makes nonsense or is not installed, the compiler takes its place", "[fuse]")
{
    if (host::allBitcode().empty())
    {
        WARN ("skipped: this was built without clang");
        return;
    }
    const auto script = GENERATE (as<std::string> {}, "echo 'error: no' >&2; exit 1", "kill -9 $$", "exit 0", "exit 3", "cp /etc/passwd \"$2\"");
    INFO (script);
    const auto plan = smallPlan(), other = smallPlan();
    const FakeCompiler compiler { copies (test::compiledFusion (host::FusedCode::of (*plan))), script };
    Fuser fuser { compiler.options() };
    CHECK_FALSE (fuser.poll (plan, 0.0));
    CHECK (fuser.describe() == "plan, fusing");
    CHECK (compiler.runs() == 0);
    CHECK_FALSE (finish (fuser, plan, 0.0));
    CHECK (fuser.state() == Fuser::State::fused);
    CHECK (fuser.account().find ("by the compiler") != std::string::npos);
    CHECK (compiler.runs() == 1);
    CHECK (plan->isFused());
    CHECK (outputs (*plan, 50) == outputs (*other, 50));
}

TEST_CASE ("if LLVM hangs, it is ended, and the compiler takes its place", "[fuse]")
{
    if (host::allBitcode().empty())
    {
        WARN ("skipped: this was built without clang");
        return;
    }
    const auto plan = smallPlan();
    const FakeCompiler compiler { copies (test::compiledFusion (host::FusedCode::of (*plan))), "while true; do sleep 1; done" };
    Fuser fuser { compiler.options() };
    CHECK_FALSE (fuser.poll (plan, 0.0));
    CHECK_FALSE (fuser.poll (plan, 59.0));
    CHECK (compiler.runs() == 0);
    CHECK_FALSE (finish (fuser, plan, 61.0));
    CHECK (fuser.state() == Fuser::State::fused);
    CHECK (compiler.runs() == 1);
}
