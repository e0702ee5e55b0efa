// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <tactus/file/atomic_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/schema/graph_schema.hpp>
#include <tactus/text/json_writer.hpp>

#include <iostream>
#include <memory>
#include <string>

namespace tactus::host
{

namespace
{
void run (const std::string& path)
{
    const auto text = writeJson (graphSchema (catalogue()));
    if (path.empty())
    {
        std::cout << text;
        return;
    }
    auto file = orFail (AtomicFile::create (path));
    file.stream() << text;
    if (auto written = file.commit(); ! written) fail (std::move (written).error());
}
}   // namespace

void addSchema (const Command& app)
{
    const auto out = std::make_shared<std::string>();
    const auto command = app.add ("schema", "Print the JSON schema of graph files, with which editors complete and check them");
    command.addOption ("-o,--out", *out, "The file to write; default: the standard output");
    addPlugins (command);
    command.footer ("Name the file at the top of a graph: { \"$schema\": \"graph.schema.json\", \"format\": \"tactus-graph\", …\n\n"
                    "Examples:\n"
                    "  tactus schema -o graph.schema.json\n"
                    "  tactus schema -o graph.schema.json --plugins my_nodes/build   with the nodes of your plugins");
    command.callback ([out] { run (*out); });
}

}   // namespace tactus::host
