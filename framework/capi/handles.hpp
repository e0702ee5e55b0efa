// SPDX-License-Identifier: MIT
#pragma once

/// The objects that the handles of the C API point to. Only this folder and framework/python/ include this.

#include "caller_assets.hpp"
#include "caller_structs.hpp"
#include "guard_watch.hpp"
#include "probe_queue.hpp"
#include "pushed_device.hpp"
#include "tactus.h"

#include <tactus/graph/history.hpp>
#include <tactus/graph/reconcile.hpp>
#include <tactus/kit/threads/spsc_ring.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/run.hpp>
#include <tactus/run/stepper.hpp>
#include <tactus/run/tick_clock.hpp>
#include <tactus/text/message.hpp>

#include <atomic>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

struct tactus_graph
{
    tactus::graph::History history;
};

/// The graph of the handle. If it was read apart from the one that plays, it gets its ids by name, in `copy`, so that what both contain continues.
inline const tactus::graph::Graph& continuing (const tactus_graph& g, const tactus::graph::Graph& playing, std::optional<tactus::graph::Graph>& copy)
{
    const auto& next = g.history.graph();
    if (haveNodesInCommon (next, playing)) return next;
    reconcile (copy.emplace (next), playing);
    return *copy;
}

/// Copies the recorded values of each tick for the main thread.
class tactus_recorder final : public tactus::RunListener
{
public:
    void after (const tactus::Plan& plan, std::uint64_t, bool) noexcept override
    {
        if (! ring || is_paused) return;
        const auto& taps = plan.taps();
        if (const auto row = ring->claim(); ! row.empty())
            for (std::size_t i = 0; i < row.size() && i < taps.size(); ++i)
                row[i] = *taps[i].value;
        ring->commit();
    }

    /// Moves recorded ticks, the oldest first, into up to `most` rows. Returns how many. [main thread]
    std::size_t collect (double* rows, std::size_t most) noexcept
    {
        if (rows == nullptr || ! ring) return 0;
        std::size_t count = 0;
        while (count < most)
        {
            const auto values = ring->front();
            const auto frames = std::min (values.size() / ring->width(), most - count);
            if (frames == 0) break;
            std::copy_n (values.begin(), frames * ring->width(), rows + count * ring->width());
            ring->take (frames);
            count += frames;
        }
        return count;
    }

    std::uint64_t lost() const noexcept { return ring ? ring->lost() : 0; }

    std::unique_ptr<tactus::SpscRing<double>> ring;
    bool is_paused = false;   // [tick thread]
};

struct tactus_run
{
    tactus_run (tactus::CompileOptions o, tactus::capi::AssetReader r) : options (std::move (o)), assets (r) {}

    tactus::CompileOptions options;
    tactus::capi::CallerAssets assets;   // must outlive the run
    tactus::graph::Graph graph;
    std::map<std::string, tactus::DeviceOption> described;                        // by role; replaces the graph's description
    std::map<std::string, std::unique_ptr<tactus::capi::PushedDevice>> waiting;   // by role, until the run opens them
    std::map<std::string, tactus::GuardLimits> limits;                            // of pushed devices, by role
    std::map<std::string, tactus::capi::PushedDevice*, std::less<>> pushed;       // by role; the run owns them
    std::vector<std::string> roles, names, units;
    std::map<std::string, double, std::less<>> turned;   // controls, by id, since the graph last set them
    std::string log;                                     // the file of the log; empty: none
    std::vector<std::string> sets;                       // as the caller wrote them, for the log
    std::optional<tactus::Message> log_trouble;          // not told yet
    tactus_recorder recorder;
    tactus::capi::GuardWatch guards;
    tactus::capi::ProbeQueue probes;
    std::optional<tactus::AbsoluteTimer> clock;   // must outlive the run
    std::unique_ptr<tactus::Run> run;
    std::optional<tactus::Stepper> stepper;   // once the run is open
    bool is_open = false, has_stopped = false;
    std::atomic<bool> has_started = false, has_ended = false;   // has_started: the run is live   [any thread]
};

namespace tactus::capi
{

inline void add (tactus_messages* to, Messages messages)
{
    if (to != nullptr) std::ranges::move (messages, std::back_inserter (to->list));
}

inline tactus_result failed (tactus_messages* to, Message why)
{
    if (to != nullptr) to->list.push_back (std::move (why));
    return TACTUS_FAILED;
}

inline tactus_result asResult (tactus_messages* to, Result<> result) { return result ? TACTUS_OK : failed (to, std::move (result).error()); }

inline std::string text (const char* t) { return t != nullptr ? t : ""; }

/// Runs a function of the API and lets no exception escape.
template <typename R, typename F>
R guarded (tactus_messages* messages, R on_failure, F&& f) noexcept
{
    const auto report = [&] (const char* id, const char* what) {
        try
        {
            if (messages != nullptr) messages->list.push_back (Message::error (id, "", what, "free what you no longer use, and try again"));
        }
        catch (...)
        {
        }
    };
    try
    {
        return f();
    }
    catch (const std::bad_alloc&)
    {
        report ("api/no_memory", "there is not enough memory");
        if constexpr (std::is_same_v<R, tactus_result>) return TACTUS_NO_MEMORY;
    }
    catch (const std::exception& e)
    {
        report ("api/exception", e.what());
    }
    return on_failure;
}

inline bool isTickedByCaller (const tactus_run* r) noexcept { return r != nullptr && r->is_open && ! r->has_ended && ! r->run->isLive(); }
inline tactus_result notTickedByCaller() noexcept { return misuse ("the run is NULL, not open, started or stopped, so it cannot be ticked here"); }

/// Compiles a graph. The catalogue must outlive the run. Null, with the reasons in `messages`, if the graph does not compile.
tactus_run* makeRun (graph::Graph, CompileOptions, AssetReader, const Catalogue&, tactus_messages*);

/// The state of a run. `is_live`: Run::start has returned. [any thread]
inline tactus_status statusOf (const Run& run, bool is_live) noexcept
{
    tactus_status status TACTUS_STATUS;
    if (is_live)
    {
        const auto now = run.live().status();
        status.phase = static_cast<tactus_phase> (static_cast<std::uint32_t> (now.phase) + 1);
        status.ticks = now.ticks;
        status.late_ticks = now.misses;
        status.force = now.force;
        status.peak_force = now.peak;
    }
    status.is_emergency = run.engine().isEmergency();
    return status;
}

inline tactus_result giveControl (tactus_control* to, const graph::Control& from, double value, tactus_messages* messages)
{
    if (! isSized (to, messages)) return TACTUS_MISUSE;
    return give (to, tactus_control { sizeof (tactus_control), from.id.c_str(), from.name.c_str(), value });
}

/// A list of texts of the caller.
inline std::vector<std::string> list (const char* const* texts, std::size_t count)
{
    std::vector<std::string> all;
    for (std::size_t i = 0; texts != nullptr && i < count; ++i)
        all.push_back (text (texts[i]));
    return all;
}

/// A copy that C code frees with tactus_text_free.
inline char* copied (const std::string& text)
{
    char* copy = static_cast<char*> (std::malloc (text.size() + 1));
    if (copy != nullptr) std::memcpy (copy, text.c_str(), text.size() + 1);
    return copy;
}

}   // namespace tactus::capi
