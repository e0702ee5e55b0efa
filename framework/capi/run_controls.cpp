// SPDX-License-Identifier: MIT
// What a program turns and probes while a run plays: vectors, choices, controls and ports.
#include "handles.hpp"

#include <tactus/run/turn.hpp>
#include <tactus/text/json.hpp>

using namespace tactus::capi;

namespace
{
/// The position of a control in the graph that plays.
double positionOf (const tactus_run& r, const tactus::graph::Control& control)
{
    if (const auto turned = r.turned.find (control.id); turned != r.turned.end()) return turned->second;
    for (const auto& set : r.options.overrides)
        if (set.name == control.id && set.value.is_number()) return set.value.get<double>();
    return control.value;
}
}   // namespace

tactus_result tactus_run_set_vector (tactus_run* r, const char* param, const double* values, size_t count, tactus_messages* messages)
{
    if (r == nullptr || values == nullptr) return misuse ("a handle or pointer is NULL");
    return guarded (messages, TACTUS_FAILED, [&] {
        auto list = tactus::Json::array();
        for (size_t i = 0; i < count; ++i)
            list.push_back (values[i]);
        return asResult (messages, tactus::turnParam (r->run->engine(), text (param), list));
    });
}

tactus_result tactus_run_set_value (tactus_run* r, const char* param, const char* value, tactus_messages* messages)
{
    if (r == nullptr || value == nullptr) return misuse ("a handle or pointer is NULL");
    return guarded (messages, TACTUS_FAILED, [&] {
        return asResult (messages, tactus::turnParam (r->run->engine(), text (param), tactus::readValue (value)));
    });
}

size_t tactus_run_control_count (const tactus_run* r) { return r != nullptr ? r->graph.controls.size() : 0; }

const char* tactus_run_control_id (const tactus_run* r, size_t i)
{
    return r != nullptr && i < r->graph.controls.size() ? r->graph.controls[i].id.c_str() : nullptr;
}

tactus_result tactus_run_get_control (const tactus_run* r, const char* id, tactus_control* to, tactus_messages* messages)
{
    if (r == nullptr || id == nullptr) return misuse ("a handle or pointer is NULL");
    return guarded (messages, TACTUS_FAILED, [&] {
        const auto found = tactus::findControl (r->graph, id);
        return found ? giveControl (to, **found, positionOf (*r, **found), messages) : failed (messages, found.error());
    });
}

tactus_result tactus_run_turn (tactus_run* r, const char* id, double value, tactus_messages* messages)
{
    if (r == nullptr || id == nullptr) return misuse ("a handle or pointer is NULL");
    return guarded (messages, TACTUS_FAILED, [&] {
        auto turns = tactus::turnControl (r->run->engine(), r->graph, id, value);
        if (turns) r->turned[id] = value;
        return asResult (messages, std::move (turns));
    });
}

//==============================================================================
tactus_result tactus_run_probe (tactus_run* r, const char* const* ports, size_t count, tactus_messages* messages)
{
    if (r == nullptr || (ports == nullptr && count > 0)) return misuse ("a handle or pointer is NULL");
    if (! r->is_open) return misuse ("the run is not open: call tactus_run_open first");
    return guarded (messages, TACTUS_FAILED, [&] { return asResult (messages, r->probes.probe (*r->run, r->graph, list (ports, count))); });
}

size_t tactus_run_probe_count (const tactus_run* r) { return r != nullptr ? r->probes.names().size() : 0; }

const char* tactus_run_probe_name (const tactus_run* r, size_t i)
{
    return i < tactus_run_probe_count (r) ? r->probes.names()[i].c_str() : nullptr;
}

tactus_result tactus_run_probed (tactus_run* r, double* values, size_t count)
{
    if (r == nullptr || values == nullptr) return misuse ("a handle or pointer is NULL");
    if (count < r->probes.values().size()) return misuse ("there is not enough room for the values of all probes");
    r->probes.drain();
    std::ranges::copy (r->probes.values(), values);
    return TACTUS_OK;
}

size_t tactus_run_collect_probes (tactus_run* r, uint64_t* ticks, double* rows, size_t most)
{
    return r != nullptr ? r->probes.collect (ticks, rows, most) : 0;
}

uint64_t tactus_run_lost_probes (const tactus_run* r) { return r != nullptr ? r->probes.lost() : 0; }
