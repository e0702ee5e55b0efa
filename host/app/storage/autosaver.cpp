// SPDX-License-Identifier: GPL-3.0-or-later
#include "autosaver.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/text/caught.hpp>

#include <utility>

namespace tactus::host
{

Autosaver::Autosaver (RecoverySession& s) : session (s), thread ([this] { static_cast<void> (caught ({}, [this] { work(); })); }) {}

Autosaver::~Autosaver()
{
    {
        const std::lock_guard lock (mutex);
        ends = true;
    }
    changed.notify_all();
}

bool Autosaver::isIdle() const
{
    const std::lock_guard lock (mutex);
    return ! next && ! is_writing;
}

void Autosaver::write (Copy copy)
{
    {
        const std::lock_guard lock (mutex);
        next = std::move (copy);
    }
    changed.notify_all();
}

void Autosaver::finish()
{
    std::unique_lock lock (mutex);
    changed.wait (lock, [this] { return ! next && ! is_writing; });
}

std::optional<Message> Autosaver::takeProblem()
{
    const std::lock_guard lock (mutex);
    return std::exchange (problem, {});
}

Result<> Autosaver::writeOne (const Copy& copy)
{
    auto document = copy.document;
    document.graph = writeGraph (copy.graph);
    document.changed = document.graph != copy.saved;
    if (copy.ui.is_object())
    {
        auto written = copy.graph;
        written.extra["ui"] = copy.ui;
        document.graph = writeGraph (written);
    }
    return session.autosave (document);
}

void Autosaver::work()
{
    std::unique_lock lock (mutex);
    for (;;)
    {
        changed.wait (lock, [this] { return ends || next; });
        if (! next) return;
        const auto copy = std::move (*std::exchange (next, {}));
        is_writing = true;
        lock.unlock();
        auto done = caught (session.folder().string(), [&] { return writeOne (copy); });
        lock.lock();
        is_writing = false;
        if (! done) problem = std::move (done).error();
        changed.notify_all();
    }
}

}   // namespace tactus::host
