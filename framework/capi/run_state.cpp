// SPDX-License-Identifier: MIT
// The state of a run as bytes.
#include "handles.hpp"

#include <tactus/kit/state_archive.hpp>

#include <cstring>

using namespace tactus::capi;

namespace
{
/// The part of a state that this API adds: where the controls stand, and the rest of a step.
tactus::Run::MoreState moreOf (tactus_run& r)
{
    return [&r] (tactus::StateArchive& archive) {
        archive (*r.stepper);
        for (const auto& control : r.graph.controls)
        {
            const auto found = r.turned.find (control.id);
            bool is_turned = found != r.turned.end();
            double at = is_turned ? found->second : 0.0;
            archive (is_turned, at);
            if (archive.restores() && is_turned)
                r.turned[control.id] = at;
            else if (archive.restores())
                r.turned.erase (control.id);
        }
    };
}
}   // namespace

tactus_result tactus_run_save (tactus_run* r, void* bytes, size_t room, size_t* size, tactus_messages* messages)
{
    if (size == nullptr || (bytes == nullptr && room > 0)) return misuse ("a pointer is NULL");
    if (! isTickedByCaller (r)) return notTickedByCaller();
    return guarded (messages, TACTUS_FAILED, [&] {
        const auto state = r->run->save (r->graph, moreOf (*r));
        if (! state) return failed (messages, state.error());
        *size = state->size();
        if (state->size() <= room) std::memcpy (bytes, state->data(), state->size());
        return TACTUS_OK;
    });
}

tactus_result tactus_run_restore (tactus_run* r, const void* bytes, size_t size, tactus_messages* messages)
{
    if (bytes == nullptr) return misuse ("a pointer is NULL");
    if (! isTickedByCaller (r)) return notTickedByCaller();
    return guarded (messages, TACTUS_FAILED, [&] {
        auto restored = r->run->restore ({ static_cast<const std::byte*> (bytes), size }, r->graph, moreOf (*r));
        r->guards.look();
        if (! restored) return failed (messages, std::move (restored).error());
        for (const auto& [role, device] : r->run->devices())
            if (const auto pushed = r->pushed.find (role); pushed != r->pushed.end()) pushed->second->shorten (device.limits);
        return TACTUS_OK;
    });
}
