// SPDX-License-Identifier: MIT
#include "graph.hpp"
#include "logs.hpp"
#include "run.hpp"

#include <pybind11/stl.h>

#include <tactus/node/catalogue.hpp>
#include <tactus/plugin/plugin_library.hpp>

#include <algorithm>

namespace
{
/// Adds these nodes of a plugin that libtactus_live has loaded. They replace nodes of the same ids, because libtactus_live has judged that already.
void loadPlugin (const std::string& file, const std::vector<std::string>& ids)
{
    auto loaded = tactus::loadPlugins ({ file }, tactus::Catalogue {});
    std::erase_if (loaded.types, [&] (const tactus::NodeType& type) { return std::ranges::find (ids, type.info.id) == ids.end(); });
    tactus::extendCatalogue (std::move (loaded.types));
    tactus::python::report (loaded.messages);
}
}   // namespace

PYBIND11_MODULE (_tactus, module)
{
    module.doc() = "The C++ side of the package tactus. Its functions may change from version to version; use those of tactus.";
    module.def ("version", [] { return tactus_version(); });
    module.def ("nodes_json", [] {
        const std::unique_ptr<char, void (*) (char*)> text { tactus_nodes_json(), tactus_text_free };
        return std::string (text ? text.get() : "[]");
    });
    module.def ("set_limits", [] (const std::string& limits) {
        tactus_messages messages;
        tactus_set_limits (limits.c_str(), &messages);
        tactus::python::report (messages.list);
    });
    module.def ("load_plugin", &loadPlugin);
    tactus::python::bindGraph (module);
    tactus::python::bindRun (module);
    tactus::python::bindLogs (module);
    tactus::python::bindPoints (module);
}
