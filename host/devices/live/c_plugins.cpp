// SPDX-License-Identifier: MIT
// The C API of node plugins (tactus_live.h).
#include <framework/capi/handles.hpp>
#include <host/code/plugins/installed_plugins.hpp>
#include <host/code/plugins/live_plugins.hpp>
#include <tactus/tactus_live.h>

using tactus::capi::add;
using tactus::capi::guarded;
using tactus::capi::misuse;

namespace
{
tactus_result told (tactus_messages* to, tactus::Messages messages)
{
    const bool is_refused = tactus::hasErrors (messages);
    add (to, std::move (messages));
    return is_refused ? TACTUS_FAILED : TACTUS_OK;
}
}   // namespace

tactus_result tactus_plugins_load (const char* path, tactus_messages* messages)
{
    if (path != nullptr && *path == '\0') return misuse ("the path is empty: give NULL for the usual folders");
    return guarded (messages, TACTUS_FAILED, [&] { return told (messages, tactus::host::loadMore (tactus::capi::text (path))); });
}

tactus_result tactus_plugins_replace (const char* plugin, tactus_messages* messages)
{
    if (plugin == nullptr) return misuse ("the plugin is NULL");
    return guarded (messages, TACTUS_FAILED, [&] { return told (messages, tactus::host::replaceBy (plugin)); });
}

tactus_result tactus_plugins_compile (const char* header, const char* plugin, tactus_messages* messages)
{
    if (header == nullptr || plugin == nullptr) return misuse ("the header or the plugin is NULL");
    return guarded (messages, TACTUS_FAILED, [&] { return told (messages, tactus::host::compileHeader (header, plugin)); });
}
