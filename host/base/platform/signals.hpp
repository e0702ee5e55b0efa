// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>

namespace tactus::host
{

/// From now on, a stop request (Ctrl-C, Ctrl-Z, Ctrl-\\, a closed terminal or pipe, kill, a timer, a limit on CPU time) is recorded
/// instead of ending or suspending the program immediately, so that forces can go to zero and files are either complete or
/// absent. Only SIGKILL and SIGSTOP cannot be caught, and faults are left to Failsafe. [main thread]
void watchForStop() noexcept;

/// True once a stop was requested. [any thread]
bool stopRequested() noexcept;

/// Requests a stop, as a signal does. [any thread]
void requestStop() noexcept;

/// True once the thread that runs main() has ended by pthread_exit, while other threads of the process go on. False on systems that do not tell:
/// only Linux with /proc does. It reads a file. [any thread but the tick thread]
bool mainThreadHasEnded() noexcept;

/// From now on, the signals of watchForEmergency wait for a thread that calls takeEmergencySignals(). Applies to the calling thread
/// and to those that it starts later, so call it before there are other threads. [main thread]
void holdEmergencySignals() noexcept;

/// From now on, the calling thread handles the signals that the other threads hold. [any thread]
void takeEmergencySignals() noexcept;

/// A guard of threads against signals. While it exists, the calling thread and those that it starts receive no signals but those of faults. So the
/// handlers of a program that uses libtactus_live run on its own threads, and not on one that ticks. [any thread]
class HeldSignals
{
public:
    HeldSignals() noexcept;
    ~HeldSignals();
    HeldSignals (const HeldSignals&) = delete;
    HeldSignals& operator= (const HeldSignals&) = delete;

private:
#if defined(__unix__) || defined(__APPLE__)
    sigset_t before;
#endif
};

/// Sets the actions of two signals, on systems that have them: SIGUSR1 calls `stop`, the emergency stop; SIGUSR2, which rearmed in
/// earlier versions, calls `asked_to_rearm`. The system calls these functions on any thread that does not hold the signals, whatever
/// the thread is doing. Null: no action. [main thread]
void watchForEmergency (void (*stop)() noexcept, void (*asked_to_rearm)() noexcept) noexcept;

}   // namespace tactus::host
