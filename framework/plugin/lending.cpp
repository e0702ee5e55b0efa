// SPDX-License-Identifier: MIT
#include "lending.hpp"
#include "imported_asset.hpp"

#include <tactus/kit/geometry/nearest_triangle.hpp>
#include <tactus/kit/threads/async_query.hpp>

#include <algorithm>
#include <type_traits>

namespace tactus::plugin
{

namespace
{
using BuildNearest = decltype (Services::nearest_triangle);

/// The questions of a node in a plugin.
class GuestQuery final : public AsyncQueryBase
{
public:
    explicit GuestQuery (const tactus_plugin_query& q) noexcept : query (q) {}
    bool answer() noexcept override { return query.answer (query.context) != 0; }

private:
    tactus_plugin_query query;
};

/// No exception may propagate into the plugin.
std::int32_t buildNearest (void* build, const tactus_plugin_mesh* mesh, tactus_plugin_nearest* made, const tactus_plugin_report*) noexcept
{
    try
    {
        auto index = (*static_cast<const BuildNearest*> (build)) (std::make_shared<const Mesh> (copyOf (*mesh)));
        made->find = [] (void* n, const double* p) noexcept -> std::int32_t { return (*static_cast<const NearestTriangle*> (n)) ({ p[0], p[1], p[2] }); };
        made->destroy = [] (void* n) noexcept { delete static_cast<NearestTriangle*> (n); };
        made->context = index.release();
        return TACTUS_PLUGIN_OK;
    }
    catch (...)
    {
        return TACTUS_PLUGIN_FAILED;
    }
}

void* addQuery (void* queries, const tactus_plugin_query* query) noexcept
{
    try
    {
        auto made = std::make_unique<GuestQuery> (*query);
        static_cast<QueryService*> (queries)->add (*made);
        return made.release();
    }
    catch (...)
    {
        return nullptr;
    }
}

void removeQuery (void* queries, void* handle) noexcept
{
    const std::unique_ptr<GuestQuery> query (static_cast<GuestQuery*> (handle));
    static_cast<QueryService*> (queries)->remove (*query);
}

std::int32_t isLate (void* queries, std::int32_t ready) noexcept { return static_cast<QueryService*> (queries)->isLate (ready != 0) ? 1 : 0; }

std::vector<const char*> textsOf (const std::vector<std::string>& all)
{
    std::vector<const char*> texts;
    for (const auto& text : all)
        texts.push_back (text.c_str());
    return texts;
}

tactus_plugin_channels shown (const Channels& c) noexcept { return { sizeof (tactus_plugin_channels), c.used(), c.begin() }; }
}   // namespace

CSetup::CSetup (const Setup& s) noexcept
{
    services.size = sizeof services;
    if (s.services.nearest_triangle)
    {
        services.meshes = const_cast<BuildNearest*> (&s.services.nearest_triangle);
        services.build_nearest = &buildNearest;
    }
    if (s.services.answers != nullptr)
    {
        services.queries = s.services.answers;
        services.add_query = &addQuery;
        services.remove_query = &removeQuery;
        services.is_late = &isLate;
    }
    setup = { sizeof setup, s.rate_hz, &services };
}

CLayout::CLayout (const DeviceLayout& l) : axes (textsOf (l.axes)), efforts (textsOf (l.efforts)), buttons (textsOf (l.buttons)),
                                           mechanics { sizeof mechanics, l.mechanics.mass, l.mechanics.damping }
{
    layout = { sizeof layout, axes.data(), axes.size(), efforts.data(), efforts.size(),
               buttons.data(), buttons.size(), l.signal_inputs, l.signal_outputs, &mechanics, l.brake };
}

ShownDevice::ShownDevice (const DeviceState& s)
    : layout (s.layout), axes (shown (s.reading.axes)), signals (shown (s.reading.signals)), applied_axes (shown (s.applied.axes)),
      applied_signals (shown (s.applied.signals))
{
    static_assert (sizeof (bool) == 1 && std::is_same_v<std::underlying_type_t<ReadingFault>, std::uint32_t>);
    const auto& r = s.reading;
    device = { .size = sizeof device,
               .layout = layout.get(),
               .position = r.position.data(),
               .rotation = r.rotation.data(),
               .pressure = &r.pressure,
               .age_s = &r.age,
               .buttons = &r.buttons,
               .fault = reinterpret_cast<const std::uint32_t*> (&r.fault),
               .valid = reinterpret_cast<const unsigned char*> (&r.valid),
               .true_position = r.true_position.data(),
               .true_velocity = r.true_velocity.data(),
               .axes = &axes,
               .signals = &signals,
               .applied_force = s.applied.force.data(),
               .applied_torque = s.applied.torque.data(),
               .applied_axes = &applied_axes,
               .applied_signals = &applied_signals,
               .state = &s,
               .applied_brake = &s.applied.brake };
}

Effort readEffort (const tactus_plugin_effort& e) noexcept
{
    Effort effort { .force = { e.force[0], e.force[1], e.force[2] }, .torque = { e.torque[0], e.torque[1], e.torque[2] }, .brake = e.brake };
    const auto read = [] (std::uint32_t count, const double* values, Channels& to) {
        for (int i = 0; i < static_cast<int> (std::min<std::uint32_t> (count, TACTUS_PLUGIN_CHANNELS)); ++i)
            to.set (i, values[i]);
    };
    read (e.axis_count, e.axes, effort.axes);
    read (e.signal_count, e.signals, effort.signals);
    return effort;
}

}   // namespace tactus::plugin
