// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/threads/snapshot.hpp>
#include <tactus/run/run.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace tactus::capi
{

/// The state of the guards of a run, for any thread: in a loop of the caller there is no runner that publishes it.
class GuardWatch final : public RunListener
{
public:
    struct Role
    {
        std::string_view name {};   // lives as long as the engine
        Guard::Stop stop {};
        std::uint32_t is_latched = 0;
        std::uint64_t is_clipping = 0;
        std::uint64_t stops = 0, changes = 0;
        Guard::Event latest {};
    };

    /// [main thread, before the first tick]
    void watch (const Engine& e)
    {
        engine = &e;
        roles = std::vector<Snapshot<Role>> (e.roleCount() + more_roles);
        published.resize (roles.size());
    }

    void after (const Plan&, std::uint64_t, bool) noexcept override { look(); }

    /// Publishes what has changed. [tick thread]
    void look() noexcept
    {
        if (engine == nullptr) return;
        const auto count = std::min (engine->roleCount(), roles.size());
        for (std::size_t i = 0; i < count; ++i)
        {
            const auto view = engine->role (i);
            const auto& guard = view.guard;
            auto& old = published[i];
            if (old.name.data() == view.name.data() && old.stop == guard.stop() && (old.is_latched != 0) == guard.isLatched()
                && (old.is_clipping != 0) == guard.isClipping() && old.changes == guard.changes() && old.stops == guard.events())
                continue;
            old = { view.name, guard.stop(), guard.isLatched(), guard.isClipping(), guard.events(), guard.changes(), guard.latest() };
            roles[i].store (old);
        }
        used.store (count, std::memory_order_release);
    }

    std::size_t size() const noexcept { return used.load (std::memory_order_acquire); }   ///< [any thread]
    Role at (std::size_t i) const noexcept { return roles[i].load(); }                    ///< [any thread]

    /// [any thread]
    std::optional<Role> find (std::string_view name) const noexcept
    {
        for (std::size_t i = 0; i < size(); ++i)
            if (const auto role = at (i); role.name == name) return role;
        return std::nullopt;
    }

private:
    static constexpr std::size_t more_roles = 16;   // that edits may add

    const Engine* engine = nullptr;
    std::vector<Snapshot<Role>> roles;
    std::vector<Role> published;   // [tick thread]
    std::atomic<std::size_t> used = 0;
};

}   // namespace tactus::capi
