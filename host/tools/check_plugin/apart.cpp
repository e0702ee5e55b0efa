// SPDX-License-Identifier: MIT
#include "apart.hpp"

#include <tactus/examine/stage.hpp>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>

#include <csignal>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tactus::check_plugin
{

namespace
{
namespace fs = std::filesystem;

constexpr int most_idle_seconds = 60, looks_per_second = 5;
constexpr rlim_t most_memory = rlim_t { 8 } << 30;   // bytes of address space: beyond it, allocations fail

/// The report of a child process to its parent, in memory that they share. The parent can read it however the child ends.
struct ChildReport
{
    examine::Stage::Place stage;
    std::atomic<int> length;   // of the answer; -1: there is no answer yet
    char answer[1 << 20];
};

class SharedReport
{
public:
    SharedReport() : memory (::mmap (nullptr, sizeof (ChildReport), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))
    {
        if (memory == MAP_FAILED) throw std::bad_alloc();
        report().length = -1;
    }
    ~SharedReport() { ::munmap (memory, sizeof (ChildReport)); }
    SharedReport (const SharedReport&) = delete;
    SharedReport& operator= (const SharedReport&) = delete;

    ChildReport& report() const noexcept { return *static_cast<ChildReport*> (memory); }

private:
    void* memory;
};

/// The CPU time that a process has used so far, in clock ticks, and whether one of its threads runs or waits for its turn.
struct Activity
{
    unsigned long long used = 0;
    bool runs = false;
};

/// Reads the state and the CPU time from a `stat` file of the proc file system: proc(5).
Activity activityOf (const fs::path& stat)
{
    std::ifstream file (stat);
    std::string text;
    std::getline (file, text);
    const auto end_of_name = text.rfind (')');
    if (end_of_name == std::string::npos) return {};
    char state = 0;
    unsigned long long user = 0, system = 0;
    const int read = std::sscanf (text.c_str() + end_of_name + 1, " %c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %llu %llu", &state, &user, &system);
    return { read == 3 ? user + system : 0, state == 'R' || state == 'D' };
}

Activity activityOf (pid_t process)
{
    const fs::path folder = "/proc/" + std::to_string (process);
    auto all = activityOf (folder / "stat");
    std::error_code gone;
    for (const auto& thread : fs::directory_iterator (folder / "task", gone))
        all.runs = all.runs || activityOf (thread.path() / "stat").runs;
    return all;
}

/// Follows how much CPU time the work has used since it last entered a hook.
class CallWatch
{
public:
    explicit CallWatch (const examine::Stage::Place& where) noexcept : stage (where) {}

    double secondsOf (const Activity& now) noexcept
    {
        static const auto per_second = static_cast<double> (::sysconf (_SC_CLK_TCK));
        const auto call = stage.calls.load (std::memory_order_relaxed);
        if (call != last) begun = now.used;
        last = call;
        return static_cast<double> (now.used - begun) / per_second;
    }

private:
    const examine::Stage::Place& stage;
    std::uint32_t last = 0;
    unsigned long long begun = 0;
};

[[noreturn]] void workInChild (int cpu_seconds, const std::function<std::string()>& work, ChildReport& report)
{
    ::prctl (PR_SET_PDEATHSIG, SIGKILL);
    ::setpgid (0, 0);
    const rlimit budget { static_cast<rlim_t> (cpu_seconds), static_cast<rlim_t> (cpu_seconds) + 1 }, none { 0, 0 }, memory { most_memory, most_memory };
    ::setrlimit (RLIMIT_CPU, &budget);
    ::setrlimit (RLIMIT_CORE, &none);
    ::setrlimit (RLIMIT_AS, &memory);
    ::dup2 (STDERR_FILENO, STDOUT_FILENO);
    examine::Stage::keepIn (&report.stage);
    std::string answer;
    try
    {
        answer = work();
    }
    catch (const std::exception& e)
    {
        std::fprintf (stderr, "%s\n", e.what());
        std::abort();
    }
    const auto length = std::min (answer.size(), sizeof report.answer);
    std::memcpy (report.answer, answer.data(), length);
    report.length = static_cast<int> (length);
    ::_exit (0);
}

enum class Outcome
{
    ended,
    looped,   ///< one call used up its CPU time
    waited    ///< no thread ran for a minute
};

/// Waits until the child has ended; then the pipe closes. If a call of the child loops or the child waits forever, kills it.
Outcome waitFor (pid_t child, int pipe, const Budget& budget, const examine::Stage::Place& stage)
{
    pollfd closing { pipe, POLLIN, 0 };
    CallWatch call { stage };
    Activity before;
    for (int idle = 0; ::poll (&closing, 1, 1000 / looks_per_second) <= 0;)
    {
        const auto now = activityOf (child);
        idle = now.runs || now.used != before.used ? 0 : idle + 1;
        before = now;
        const bool loops = call.secondsOf (now) >= budget.call_seconds;
        if (! loops && idle < most_idle_seconds * looks_per_second) continue;
        ::kill (-child, SIGKILL);
        return loops ? Outcome::looped : Outcome::waited;
    }
    return Outcome::ended;
}

std::string endOf (int status)
{
    if (WIFEXITED (status)) return "the program was ended with exit status " + std::to_string (WEXITSTATUS (status));
    const int signal = WTERMSIG (status);
    return "the program was ended by signal " + std::to_string (signal) + " (" + ::strsignal (signal) + ")";
}

std::string seconds (int n) { return std::to_string (n) + " s of CPU time"; }

ProcessResult resultOf (const ChildReport& report, int status, const rusage& used, Outcome outcome, const Budget& budget)
{
    if (const int length = report.length; WIFEXITED (status) && WEXITSTATUS (status) == 0 && length >= 0)
        return { .done = true, .answer = std::string (report.answer, static_cast<std::size_t> (length)) };
    const bool spent = WIFSIGNALED (status) && used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1 >= budget.cpu_seconds
                       && (WTERMSIG (status) == SIGXCPU || WTERMSIG (status) == SIGKILL);
    std::string why = endOf (status);
    if (outcome == Outcome::waited)
        why = "never stops waiting";
    else if (outcome == Outcome::looped)
        why = "did not return within " + seconds (budget.call_seconds);
    else if (spent)
        why = "returns, but everything together did not finish within " + seconds (budget.cpu_seconds);
    const char* hook = report.stage.hook;
    const auto place = hook != nullptr ? "`" + std::string (hook) + "`" + (budget.of.empty() ? "" : " of " + budget.of) + ": " : std::string();
    return { .why = place + why, .endless = outcome != Outcome::ended || spent };
}
}   // namespace

ProcessResult runApart (const Budget& budget, const std::function<std::string()>& work)
{
    const SharedReport shared;
    int ends[2];
    if (::pipe (ends) != 0) return { .why = "a pipe could not be created" };
    std::fflush (nullptr);   // otherwise buffered output would be written twice
    const auto child = ::fork();
    if (child == 0)
    {
        ::close (ends[0]);
        workInChild (budget.cpu_seconds, work, shared.report());
    }
    ::close (ends[1]);
    if (child < 0)
    {
        ::close (ends[0]);
        return { .why = "a process could not be started" };
    }
    const auto outcome = waitFor (child, ends[0], budget, shared.report().stage);
    int status = 0;
    rusage used {};
    ::wait4 (child, &status, 0, &used);
    ::close (ends[0]);
    ::kill (-child, SIGKILL);   // processes that the child may have started
    return resultOf (shared.report(), status, used, outcome, budget);
}

}   // namespace tactus::check_plugin
