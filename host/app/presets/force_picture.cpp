// SPDX-License-Identifier: GPL-3.0-or-later
#include "force_picture.hpp"

#include <host/app/text/filled.hpp>
#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/engine.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace tactus::host
{

namespace
{
std::string firstError (const Messages& messages)
{
    const auto error = std::ranges::find (messages, Message::Severity::error, &Message::severity);
    return error == messages.end() ? TRANS ("the graph cannot run").toStdString() : error->text;
}

constexpr std::size_t most_parts = 64;   // components that the picture of the material reads

/// The tools and the recorded values at the tick of the largest force.
class PeakForce
{
public:
    void note (Engine& engine, const std::vector<std::string>& roles)
    {
        double force = 0.0;
        for (std::size_t i = 0; i < engine.roleCount(); ++i)
            force += engine.role (i).applied.force.norm();
        if (force <= most) return;
        most = force;
        tools.clear();
        for (std::size_t i = 0; i < engine.roleCount(); ++i)
            tools.push_back ({ roles[i], engine.plan().roles()[i].state->reading.position, engine.role (i).applied.force });
        values.clear();
        for (const auto& tap : engine.plan().taps())
            values.emplace (tap.name, *tap.value);
    }

    scene::SceneState now (const std::vector<scene::Body>& bodies) const
    {
        const auto valueOf = [this] (const std::string& component) {
            const auto found = values.find (component);
            return found == values.end() ? std::nullopt : std::optional (found->second);
        };
        return { tools, scene::liveOf (bodies, valueOf) };
    }

private:
    double most = 0.0;   // N
    std::vector<scene::Tool> tools;
    std::map<std::string, double> values;
};
}   // namespace

ForcePicture pictureOf (const std::filesystem::path& file, const Catalogue& catalogue, const std::atomic<bool>& cancelled)
{
    ForcePicture picture;
    const auto refuse = [&] (std::string why) {
        picture.problem = std::move (why);
        return picture;
    };
    auto loaded = loadGraph (file);
    if (hasErrors (loaded.messages)) return refuse (firstError (loaded.messages));
    FileAssets assets;
    CompileOptions options { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } };
    auto compiled = compile (loaded.graph, catalogue, options);
    if (! compiled.plan) return refuse (firstError (compiled.messages));
    auto bodies = scene::bodiesOf (*compiled.plan);
    options.records = scene::portsOf (bodies, most_parts);
    if (! options.records.empty()) compiled = compile (loaded.graph, catalogue, options);   // what the picture of the material shows
    if (! compiled.plan) return refuse (firstError (compiled.messages));

    const auto rate_hz = loaded.graph.rate_hz;
    std::vector<std::string> roles;
    for (const auto& role : compiled.plan->roles())
        roles.push_back (role.name);
    if (roles.empty()) return refuse (TRANS ("no preview: the graph has no device node").toStdString());
    std::vector<MadeDevice> devices;   // must outlive the engine
    for (const auto& role : roles)
    {
        Messages said_by_run;
        devices.push_back (makeDevice (describedByGraph (loaded.graph.device (role), role, said_by_run), loaded.graph.folder));
        if (! devices.back().device) return refuse (firstError (devices.back().messages));
        picture.seconds = std::max (picture.seconds, devices.back().device->duration());
    }
    if (picture.seconds <= 0.0) return refuse (TRANS ("no preview: the hand does not move by itself").toStdString());
    picture.seconds = std::min (picture.seconds, ForcePicture::longest_s);

    Engine engine (std::move (compiled.plan));
    PeakForce pressed;
    for (std::size_t i = 0; i < roles.size(); ++i)
        engine.attach (roles[i], *devices[i].device, devices[i].limits);
    std::vector<float> forces (ForcePicture::columns), torques (ForcePicture::columns);
    const auto ticks = static_cast<std::size_t> (picture.seconds * rate_hz);
    for (std::size_t k = 0; k < ticks; ++k)
    {
        if (cancelled.load (std::memory_order_relaxed)) return refuse ("cancelled");
        engine.tick();
        const auto column = k * ForcePicture::columns / ticks;
        for (std::size_t i = 0; i < engine.roleCount(); ++i)
        {
            const auto& applied = engine.role (i).applied;
            forces[column] = std::max (forces[column], static_cast<float> (applied.force.norm()));
            torques[column] = std::max (torques[column], static_cast<float> (applied.torque.norm()));
        }
        pressed.note (engine, roles);
    }
    const auto now = pressed.now (bodies);
    picture.material = materialOf (std::move (bodies), now);
    const bool turns = *std::ranges::max_element (forces) == 0.0f && *std::ranges::max_element (torques) > 0.0f;
    picture.unit = turns ? "N m" : "N";
    picture.peaks = std::move (turns ? torques : forces);
    picture.peak = static_cast<double> (*std::ranges::max_element (picture.peaks));
    return picture;
}

}   // namespace tactus::host
