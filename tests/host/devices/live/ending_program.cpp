// SPDX-License-Identifier: MIT
// ending_program GRAPH DEVICE WAY: a program that plays a graph through libtactus_live, and ends in one of the ways in which programs end, without a call
// that stops the session. c_ending_test.py looks at the device.
#include <tactus/tactus_live.h>

#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>

namespace
{
[[noreturn]] void forEver()
{
    for (;;)
        ::pause();
}

tactus_session* started (const char* file, const char* device)
{
    auto* const messages = tactus_messages_create();
    auto* const graph = tactus_graph_load (file, messages);
    tactus_session_options options = TACTUS_SESSION_OPTIONS;
    options.devices = &device;
    options.device_count = 1;
    options.session = "off";
    auto* const session = graph != nullptr ? tactus_session_open (graph, &options, messages) : nullptr;
    const bool plays = session != nullptr && tactus_session_start (session, messages) == TACTUS_OK;
    tactus_message m = TACTUS_MESSAGE;
    for (std::size_t i = 0; tactus_messages_get (messages, i, &m) == TACTUS_OK; ++i)
        std::fprintf (stderr, "%s: %s\n", m.id, m.text);
    return plays ? session : nullptr;
}

void end (const std::string& way)
{
    const std::map<std::string, int> signals { { "SIGINT", SIGINT }, { "SIGTERM", SIGTERM }, { "SIGHUP", SIGHUP }, { "SIGQUIT", SIGQUIT }, { "SIGKILL", SIGKILL }, { "SIGSEGV", SIGSEGV } };
    if (const auto s = signals.find (way); s != signals.end()) ::kill (::getpid(), s->second);
    if (way == "exit" || way == "exit, and a function of atexit that never returns") std::exit (3);   // NOLINT(concurrency-mt-unsafe)
    if (way == "exit of another thread") std::thread ([] { std::exit (3); }).join();                  // NOLINT(concurrency-mt-unsafe)
    if (way == "_exit") ::_exit (3);
    if (way == "quick_exit" || way == "quick_exit, and a function of at_quick_exit that never returns") std::quick_exit (3);
    if (way == "abort") std::abort();
    if (way == "an exception") throw std::runtime_error ("of the program");
    if (way == "an exception in another thread") std::thread ([] { throw std::runtime_error ("of the program"); }).join();
    if (way == "pthread_exit")
    {
        std::thread (forEver).detach();
        ::pthread_exit (nullptr);
    }
    if (way == "exec") ::execl ("/bin/sleep", "sleep", "600", nullptr);
    if (way == "a fork that outlives it" && ::fork() == 0) forEver();
}
}   // namespace

int main (int argc, char** argv)
{
    if (argc < 4) return 2;
    const std::string way = argv[3];
    for (const int s : { SIGINT, SIGTERM, SIGHUP, SIGQUIT })   // a shell starts what runs in the background without some of them
        std::signal (s, SIG_DFL);
    // Functions that were registered before the session come after what stops it.
    if (way.find ("of atexit") != way.npos) std::atexit ([] { forEver(); });
    if (way.find ("of at_quick_exit") != way.npos) ::at_quick_exit ([] { forEver(); });
    auto* const session = started (argv[1], argv[2]);
    if (session == nullptr) return 2;
    tactus_status status = TACTUS_STATUS;
    while (tactus_session_status (session, &status) == TACTUS_OK && status.force < 0.39)
        std::this_thread::yield();
    end (way);
    return 3;
}
