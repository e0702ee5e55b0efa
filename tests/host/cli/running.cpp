// SPDX-License-Identifier: GPL-3.0-or-later
#include "running.hpp"

#include <csignal>
#include <cstdlib>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tactus::test
{

Running::Running (const std::string& program, const std::vector<std::string>& arguments)
{
    const auto out = scratch.path ("out"), err = scratch.path ("err");
    std::vector<char*> words { const_cast<char*> (program.c_str()) };
    for (const auto& a : arguments)
        words.push_back (const_cast<char*> (a.c_str()));
    words.push_back (nullptr);

    process = fork();
    if (process != 0) return;
    const auto to = [] (const std::string& path, int descriptor) { dup2 (open (path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600), descriptor); };
    to (out, 1);
    to (err, 2);
    execvp (words[0], words.data());
    _exit (127);
}

Running::~Running()
{
    if (process <= 0) return;
    kill (static_cast<pid_t> (process), SIGKILL);
    waitpid (static_cast<pid_t> (process), nullptr, 0);
}

bool Running::says (const std::string& text, int times)
{
    return soon ([&] {
        const auto all = err();
        int n = 0;
        for (auto at = all.find (text); at != std::string::npos; at = all.find (text, at + 1))
            ++n;
        return n >= times;
    });
}

void Running::signal (int number) { kill (static_cast<pid_t> (process), number); }

Ran Running::stop()
{
    signal (SIGINT);
    return finish();
}

Ran Running::finish()
{
    int result = 0;
    waitpid (static_cast<pid_t> (process), &result, 0);
    process = -1;
    return { WIFEXITED (result) ? WEXITSTATUS (result) : -WTERMSIG (result), out(), err() };
}

}   // namespace tactus::test
