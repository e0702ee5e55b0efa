// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_job.hpp"

#include <tactus/text/caught.hpp>

#include <utility>

namespace tactus::host
{

void FitJob::start (FitKind kind, std::shared_ptr<const Table> table, std::string file, FitSettings settings)
{
    cancel();
    forgetFinished();
    work = std::make_shared<Work>();
    threads.emplace_back (work, std::jthread ([own = work, kind, table = std::move (table), file = std::move (file), settings = std::move (settings)] {
                              own->result.emplace (caught (file, [&] { return fitRecording (kind, *table, file, settings, &own->course); }));
                              own->done = true;
                          }));
}

void FitJob::cancel()
{
    if (work) work->course.cancelled = true;
    work.reset();
}

std::optional<Result<FittedGraph>> FitJob::take()
{
    if (! work || ! work->done) return {};
    auto result = std::move (work->result);
    work.reset();
    forgetFinished();
    return result;
}

void FitJob::forgetFinished()
{
    std::erase_if (threads, [] (const auto& t) { return t.first->done.load(); });
}

}   // namespace tactus::host
