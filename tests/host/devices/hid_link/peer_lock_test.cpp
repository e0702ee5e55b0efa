// SPDX-License-Identifier: MIT
// Whose lock on a device over UDP counts, tried with a process of a second user. Only root can start one.
#include "support/no_system_calls.hpp"

#include <host/base/platform/peer_lock.hpp>
#include <host/base/platform/wire_file.hpp>

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>

using namespace tactus;
using namespace tactus::host;

namespace
{
constexpr uid_t nobody = 65534, nameless = 65533;

/// A process of another user, which does something and then holds what it has until the end of this object.
class Stranger
{
public:
    explicit Stranger (const std::function<bool()>& act, uid_t user = nobody)
    {
        int ready[2] {}, ends[2] {};
        REQUIRE ((::pipe (ready) == 0 && ::pipe (ends) == 0));
        process = ::fork();
        if (process == 0)
        {
            char end = 0;
            ::close (ends[1]);
            const bool works = ::setgid (user) == 0 && ::setuid (user) == 0 && act();
            end = works ? 1 : 0;
            static_cast<void> (! ::write (ready[1], &end, 1) || ::read (ends[0], &end, 1));
            ::_exit (0);
        }
        char works = 0;
        ::close (ready[1]);
        ::close (ends[0]);
        const bool told = process > 0 && ::read (ready[0], &works, 1) == 1 && works == 1;
        ::close (ready[0]);
        holds = ends[1];
        if (! told) end();
        REQUIRE (told);
    }
    ~Stranger() { end(); }
    Stranger (const Stranger&) = delete;
    Stranger& operator= (const Stranger&) = delete;

    pid_t process = -1;

private:
    /// By a signal, because another stranger may have a copy of the pipe.
    void end()
    {
        ::close (holds);
        if (process <= 0) return;
        ::kill (process, SIGKILL);
        ::waitpid (process, nullptr, 0);
    }

    int holds = -1;
};

enum class How
{
    bound,
    listening
};

sockaddr_un nameOf (int port, int number, socklen_t& size)
{
    sockaddr_un name {};
    name.sun_family = AF_UNIX;
    const auto text = "tactus " + (number > 0 ? std::to_string (number) + " " : "") + "2 here " + std::to_string (port) + " ";
    text.copy (name.sun_path + 1, text.size());
    size = static_cast<socklen_t> (offsetof (sockaddr_un, sun_path) + 1 + text.size());
    return name;
}

/// Takes the name of a lock, as any program can.
bool grab (int port, int number, How how)
{
    socklen_t size = 0;
    const auto name = nameOf (port, number, size);
    const int file = ::socket (AF_UNIX, SOCK_STREAM, 0);
    return ::bind (file, reinterpret_cast<const sockaddr*> (&name), size) == 0 && (how == How::bound || ::listen (file, 1) == 0);
}

/// Fills the queue of a lock, so that nobody else can ask who holds it.
bool fill (int port)
{
    socklen_t size = 0;
    const auto name = nameOf (port, 0, size);
    for (;;)
    {
        const int file = ::socket (AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0);
        const bool fits = ::connect (file, reinterpret_cast<const sockaddr*> (&name), size) == 0;
        const int why = errno;
        ::close (file);
        if (! fits) return why == EAGAIN;
    }
}

constexpr auto own = "another role or another instance of Tactus is using it";
}   // namespace

TEST_CASE ("the lock of another user counts only if that user has a connection to the device", "[wires][safety]")
{
    if (::geteuid() != 0)
    {
        WARN ("skipped: only root can start a process of a second user");
        return;
    }
    int port = 0;
    const auto board = WireFile::listenUdp (port);
    REQUIRE (board);
    const auto address = "127.0.0.1:" + std::to_string (port);
    const auto mine = WireFile::connectUdp (address);
    REQUIRE (mine);
    const auto take = [&] { return PeerLock::take (mine->descriptor()); };

    SECTION ("without a connection, it takes nothing from the owner, who still holds a lock")
    {
        const auto how = GENERATE (How::bound, How::listening);
        const Stranger stranger ([&] { return grab (port, 0, how); });
        const auto lock = take();
        REQUIRE (lock);
        CHECK (take().why == own);
    }
    SECTION ("nor if it takes all names")
    {
        const Stranger stranger ([&] {
            bool all = true;
            for (int number = 0; number < PeerLock::most_names; ++number)
                all = grab (port, number, How::listening) && all;
            return all;
        });
        const auto lock = take();
        CHECK (lock);
        CHECK (take().why == own);   // two programs of the owner still exclude each other
        CHECK (PeerLock::take (mine->descriptor(), "another part"));
        CHECK (test::inChild ([&] { return take() ? 1 : 0; }).status == 0);
    }
    SECTION ("nor if it takes all names, and the owner has no folder for a lock: the message says who it is")
    {
        const Stranger stranger ([&] {
            bool all = true;
            for (int number = 0; number < PeerLock::most_names; ++number)
                all = grab (port, number, How::listening) && all;
            return all;
        });
        const auto* const before = std::getenv ("XDG_RUNTIME_DIR");
        const std::string kept = before != nullptr ? before : "";
        ::setenv ("XDG_RUNTIME_DIR", "/dev/null", 1);
        const auto refused = take();
        before != nullptr ? ::setenv ("XDG_RUNTIME_DIR", kept.c_str(), 1) : ::unsetenv ("XDG_RUNTIME_DIR");
        CHECK_FALSE (refused);
        CHECK (refused.why.starts_with ("all names of its lock are held by the user nobody (process " + std::to_string (stranger.process) + ", "));
    }
    SECTION ("with a connection, it counts, and the message names user and process")
    {
        const auto how = GENERATE (How::bound, How::listening);
        std::optional<Stranger> stranger (std::in_place, [&] { return WireFile::connectUdp (address) && grab (port, 0, how); });
        // The connection of the line above has ended with its expression.
        CHECK (take());
        stranger.emplace ([&] {
            static const auto theirs = WireFile::connectUdp (address);
            return theirs && grab (port, 0, how);
        });
        const auto refused = take();
        CHECK_FALSE (refused);
        const auto process = how == How::bound ? std::string() : " (process " + std::to_string (stranger->process) + ", ";
        CHECK (refused.why.starts_with ("the user nobody is using it" + process));
        stranger.reset();
        CHECK (take());
    }
    SECTION ("another user's Tactus counts, behind names that are held without a connection, too")
    {
        const Stranger squatter ([&] { return grab (port, 0, How::listening); });
        const Stranger other ([&] {
            static const auto theirs = WireFile::connectUdp (address);
            static const auto lock = PeerLock::take (theirs->descriptor());
            return static_cast<bool> (lock); }, nameless);
        CHECK (take().why.starts_with ("the user 65533 is using it (process "));
    }
    SECTION ("nobody can hide the owner's lock from the owner's other programs")
    {
        const auto lock = take();
        REQUIRE (lock);
        const Stranger stranger ([&] { return fill (port); });
        const auto other = WireFile::connectUdp (address);
        REQUIRE (other);
        CHECK_FALSE (PeerLock::take (other->descriptor()));
        CHECK_FALSE (take());   // by a socket that the lock itself was taken with
    }
}
