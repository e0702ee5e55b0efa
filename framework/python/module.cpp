// SPDX-License-Identifier: MIT
#include "graph.hpp"
#include "run.hpp"

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
    tactus::python::bindGraph (module);
    tactus::python::bindRun (module);
}
