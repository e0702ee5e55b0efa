// SPDX-License-Identifier: MIT
#include "handles.hpp"

#include <tactus/node/catalogue.hpp>
#include <tactus/node/datasheet_json.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/json.hpp>

#include <cstdlib>

using namespace tactus::capi;

const char* tactus_version (void) { return TACTUS_LIBRARY_VERSION; }
uint32_t tactus_api_version (void) { return TACTUS_API_VERSION; }
void tactus_text_free (char* t) { std::free (t); }

char* tactus_nodes_json (void)
{
    return guarded<char*> (nullptr, nullptr,
                           [] {
                               auto all = tactus::Json::array();
                               for (const auto& type : tactus::catalogue())
                                   all.push_back (tactus::datasheetJson (type));
                               return copied (all.dump (2));
                           });
}

tactus_result tactus_set_limits (const char* limits, tactus_messages* messages)
{
    if (limits == nullptr) return misuse ("the limits are NULL");
    return guarded (messages, TACTUS_FAILED, [&] {
        auto read = tactus::readLimits (limits);
        if (! read) return failed (messages, std::move (read).error());
        tactus::setBudgets (*read);
        return TACTUS_OK;
    });
}

tactus_messages* tactus_messages_create (void) { return new (std::nothrow) tactus_messages; }
void tactus_messages_free (tactus_messages* m) { delete m; }

void tactus_messages_clear (tactus_messages* m)
{
    if (m != nullptr) m->list.clear();
}

size_t tactus_messages_count (const tactus_messages* m) { return m != nullptr ? m->list.size() : 0; }
int32_t tactus_messages_have_errors (const tactus_messages* m) { return m != nullptr && tactus::hasErrors (m->list); }

tactus_result tactus_messages_get (const tactus_messages* m, size_t index, tactus_message* to)
{
    if (m == nullptr || index >= m->list.size()) return misuse ("there is no message of this number");
    const auto& from = m->list[index];
    return give (to, tactus_message { .size = sizeof (tactus_message),
                                      .is_error = from.severity == tactus::Message::Severity::error,
                                      .id = from.id.c_str(),
                                      .where = from.where.c_str(),
                                      .text = from.text.c_str(),
                                      .remedy = from.remedy.c_str(),
                                      .file = from.file.c_str(),
                                      .line = from.line,
                                      .column = from.column });
}
