// SPDX-License-Identifier: GPL-3.0-or-later
#include "stem_job.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/devices/live/live_session.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/plan/flat/flatten.hpp>
#include <tactus/text/caught.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
const Message* errorIn (const Messages& messages)
{
    const auto found = std::ranges::find (messages, Message::Severity::error, &Message::severity);
    return found == messages.end() ? nullptr : &*found;
}
}   // namespace

void StemJob::start (graph::Graph g, const Catalogue& catalogue, std::filesystem::path folder, const StemOptions& options)
{
    cancel();
    work = std::make_shared<Work>();
    threads.emplace_back (work, std::jthread ([own = work, g = std::move (g), &catalogue, folder = std::move (folder), options] {
                              own->result.emplace (caught (folder.string(), [&] { return render (g, catalogue, folder, options, *own); }));
                              own->is_done = true;
                          }));
}

Result<WrittenStems> StemJob::render (const graph::Graph& g, const Catalogue& catalogue, const std::filesystem::path& folder, const StemOptions& options,
                                      Work& course)
{
    if (auto fits = Stems::check (folder); ! fits) return fits.error();
    FileAssets assets;
    LiveSession::Options how;
    how.compile = { .records = Stems::portsOf (plan::flatten (g, catalogue, {}, nullptr, plan::SettingFiles::left_out).flat),
                    .assets = &assets,
                    .services = { .nearest_triangle = nearestByBoxes } };
    how.queries = Run::Queries::within_tick;
    LiveSession session (catalogue, {}, how);
    const auto loaded = session.load (g);
    if (const auto* error = errorIn (loaded)) return *error;
    const auto opened = session.openDevices();
    if (const auto* error = errorIn (opened)) return *error;

    auto& run = session.run();
    double seconds = 0.0;
    for (const auto& [role, d] : run.devices())
        seconds = std::max (seconds, d.device->duration());
    constexpr double usual_s = 10.0, most_s = 600.0;
    const auto ticks = static_cast<std::size_t> (std::ceil (run.rate() * (seconds > 0.0 ? std::min (seconds, most_s) : usual_s) - 1e-6));
    Stems stems (run.engine().plan(), options);
    for (std::size_t k = 0; k < ticks; ++k)
    {
        run.tick();
        if (auto taken = stems.frame(); ! taken) return taken.error();
        course.share = static_cast<double> (k) / static_cast<double> (ticks);
        if (course.is_cancelled) return Message::error ("run/interrupted", {}, "cancelled; nothing was written", "export the stems again to get them");
    }
    course.share = 1.0;
    return stems.write (folder, g.name);
}

void StemJob::cancel()
{
    if (work) work->is_cancelled = true;
    work.reset();
    forgetFinished();
}

std::optional<Result<WrittenStems>> StemJob::take()
{
    if (! work || ! work->is_done) return {};
    auto result = std::move (work->result);
    work.reset();
    forgetFinished();
    return result;
}

void StemJob::forgetFinished()
{
    std::erase_if (threads, [] (const auto& t) { return t.first->is_done.load(); });
}

}   // namespace tactus::host
