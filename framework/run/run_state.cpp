// SPDX-License-Identifier: MIT
#include "run.hpp"

#include "log/content_hash.hpp"
#include "log/graph_snapshot.hpp"

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/state_archive.hpp>
#include <tactus/text/quote.hpp>

#include <array>

namespace tactus
{

namespace
{
constexpr std::uint32_t state_format = 2;   // of what this file writes

std::string_view textOf (std::span<const std::byte> bytes) noexcept { return { reinterpret_cast<const char*> (bytes.data()), bytes.size() }; }

void append (std::vector<std::byte>& to, std::string_view text)
{
    const auto* bytes = reinterpret_cast<const std::byte*> (text.data());
    to.insert (to.end(), bytes, bytes + text.size());
}

/// The hash of the axes, buttons, signals and brakes of the roles. Limits may differ, because a state does not undo them.
std::string hashOfDevices (const std::vector<std::pair<std::string, Run::RoleDevice>>& by_role)
{
    std::string text;
    for (const auto& [role, d] : by_role)
    {
        const auto has = d.device->layout();
        for (const auto* names : { &has.axes, &has.efforts, &has.buttons })
        {
            text += quote (role) + std::to_string (names->size());
            for (const auto& name : *names)
                text += quote (name);
        }
        text += std::to_string (has.signal_inputs) + " " + std::to_string (has.signal_outputs) + " " + std::to_string (has.brake) + "\n";
    }
    return contentHash (text);
}

constexpr std::size_t hash_size = 16;
constexpr const char* state_remedy = "leave it out of runs that are saved, or let it list its state: see the page on states";

Message refused (std::string id, std::string why, std::string remedy) { return Message::error (std::move (id), "", std::move (why), std::move (remedy)); }

/// A line of the beginning of a state: a thing that must be the same where it is restored, and what is wrong if it is not.
struct HeadLine
{
    std::string text;
    const char *id, *why, *remedy;
};

std::array<HeadLine, 4> headOf (const std::string& graph_hash, double rate_hz, const std::string& devices_hash)
{
    return { HeadLine { "tactus state\n", "state/format", "this is not the state of a run", "give the bytes that save() returned, unchanged" },
             HeadLine { std::to_string (state_format) + " " + TACTUS_LIBRARY_VERSION + " " + std::to_string (math::revision) + "\n", "state/format",
                        "the state was saved by another version or another build of Tactus",
                        "save it again with this one: a state is not a file format that outlives a version" },
             HeadLine { graph_hash + " " + std::to_string (rate_hz) + "\n", "state/graph", "the state is that of another graph, or of this one at another rate",
                        "restore it into a run of the graph that it was saved from" },
             HeadLine { devices_hash + "\n", "state/graph",
                        "the state is that of a run with other devices: their axes, efforts, buttons, signals or brakes differ",
                        "restore it into a run with the same devices" } };
}

/// Why a state with the same head does not fit. What is left over, or lacks, at the end belongs to the loop.
Message doesNotFit (const std::string& why)
{
    const bool is_loop = why.starts_with ("the loop ");
    return refused ("state/graph", "the state does not fit this run: " + why,
                    is_loop ? "restore it with what it was saved with: in C++, pass the same MoreState as to save()"
                            : "restore it into a run with the same graph, options and devices");
}
}   // namespace

std::optional<Message> Run::cannotSave() const
{
    if (runner)
        return refused ("state/live", "a clock ticks the run, so it has no state at rest", "save and restore in a loop of your own, which ticks the run");
    if (running == nullptr) return refused ("state/live", "nothing has been loaded", "load a graph first");
    if (&running->newest() != &running->plan())
        return refused ("state/edit", "an edit waits for the next tick, which will begin with its plan", "run a tick, then save or restore");
    return {};
}

const std::string& Run::hashOf (const graph::Graph& graph)
{
    if (const auto serial = running->plan().serial(); serial != hashed_serial)
    {
        std::string text = snapshotHash (snapshotOf (graph, {}, graph.folder));
        for (const auto& path : assets.paths)
            text += fileHash (path).value_or ("");
        graph_hash = contentHash (text);
        hashed_serial = serial;
    }
    return graph_hash;
}

void Run::serialize (StateArchive& archive, const MoreState& more)
{
    archive (now);
    running->serialize (archive);
    archive.enter ("loop", {});
    if (more) more (archive);
}

Result<std::vector<std::byte>> Run::save (const graph::Graph& graph, const MoreState& more)
{
    if (auto why = cannotSave()) return std::move (*why);
    const auto head = headOf (hashOf (graph), rate(), hashOfDevices (by_role));
    std::vector<std::byte> bytes, state;
    state.reserve (4096);
    StateArchive archive { state };
    serialize (archive, more);
    if (archive.isRefused()) return refused ("state/refused", archive.refusal(), state_remedy);
    for (const auto& line : head)
        append (bytes, line.text);
    append (bytes, contentHash (textOf (state)));
    bytes.insert (bytes.end(), state.begin(), state.end());
    return bytes;
}

Result<> Run::restore (std::span<const std::byte> bytes, const graph::Graph& graph, const MoreState& more)
{
    if (auto why = cannotSave()) return std::move (*why);
    if (log && ! log_ended)
        return refused ("state/log", "the run is logged, and a replay of its log could not follow", "end the log first, or restore in a run without a log");
    if (running->isEmergency())
        return refused ("state/stopped", "the emergency stop is pressed, which a state does not undo", "rearm the run first, once it is safe");
    const auto head = headOf (hashOf (graph), rate(), hashOfDevices (by_role));
    auto rest = bytes;
    for (const auto& line : head)
    {
        const auto text = textOf (rest);
        if (! text.starts_with (line.text))
            return refused (line.id, std::string (line.why) + " (it says " + quote (text.substr (0, text.find ('\n'))) + ")", line.remedy);
        rest = rest.subspan (line.text.size());
    }
    if (rest.size() < hash_size || textOf (rest.first (hash_size)) != contentHash (textOf (rest.subspan (hash_size))))
        return refused ("state/damaged", "the state is cut off or has been changed", "give the bytes that save() returned, unchanged");

    std::vector<std::byte> kept;
    StateArchive keep { kept };
    serialize (keep, more);
    if (keep.isRefused()) return refused ("state/refused", keep.refusal(), state_remedy);
    const auto readFrom = [&] (std::span<const std::byte> from) {
        StateArchive archive { from };
        serialize (archive, more);
        if (! archive.isAtEnd()) archive.refuse ("has bytes that nothing reads");
        return archive.refusal();
    };
    const auto why = readFrom (rest.subspan (hash_size));
    if (why.empty()) return {};
    (void)readFrom (kept);
    return doesNotFit (why);
}

}   // namespace tactus
