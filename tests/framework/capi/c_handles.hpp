// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus.h>

#include <memory>
#include <string>

namespace tactus::test
{

/// Frees the handles of the C API.
struct FreeHandle
{
    void operator() (tactus_messages* m) const { tactus_messages_free (m); }
    void operator() (tactus_graph* g) const { tactus_graph_free (g); }
    void operator() (tactus_run* r) const { tactus_run_free (r); }
    void operator() (char* text) const { tactus_text_free (text); }
};
using MessageList = std::unique_ptr<tactus_messages, FreeHandle>;
using GraphHandle = std::unique_ptr<tactus_graph, FreeHandle>;
using RunHandle = std::unique_ptr<tactus_run, FreeHandle>;
using Text = std::unique_ptr<char, FreeHandle>;

/// All messages, one per line: "id: text".
inline std::string said (const MessageList& m)
{
    std::string all;
    tactus_message one = TACTUS_MESSAGE;
    for (size_t i = 0; tactus_messages_get (m.get(), i, &one) == TACTUS_OK; ++i)
        all += std::string (one.id) + ": " + one.text + "\n";
    return all;
}

}   // namespace tactus::test
