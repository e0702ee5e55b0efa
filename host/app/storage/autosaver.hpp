// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "recovery.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>

namespace tactus::host
{

/// Writes autosaves on its own thread, one at a time, because writing a large graph takes longer than a frame of the window. [main thread]
class Autosaver
{
public:
    /// A copy of the document to write. The thread makes the text of the graph.
    struct Copy
    {
        AutosavedDocument document {};   ///< without `graph` and `changed`
        graph::Graph graph {};
        std::string saved {};   ///< the text of the graph in its file, to find out whether it has changed
        Json ui {};             ///< written in place of that of the graph, as a file keeps it; null: that of the graph
    };

    explicit Autosaver (RecoverySession&);   ///< the session must outlive this object
    ~Autosaver();                            ///< writes what waits

    /// True if nothing is being written. A copy of a large graph takes time, too, so wait for this before you make one.
    bool isIdle() const;

    void write (Copy);
    void finish();   ///< waits until everything is written

    /// The reason why the latest writing failed; empty if it did not, or if this was asked before.
    std::optional<Message> takeProblem();

private:
    void work();
    Result<> writeOne (const Copy&);

    RecoverySession& session;
    mutable std::mutex mutex;   // protects the next members
    std::condition_variable changed;
    std::optional<Copy> next;
    std::optional<Message> problem;
    bool is_writing = false, ends = false;
    std::jthread thread;   // declared last: it uses the other members
};

}   // namespace tactus::host
