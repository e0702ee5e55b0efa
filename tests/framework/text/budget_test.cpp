// SPDX-License-Identifier: MIT
#include <tactus/text/json_text.hpp>

#include "support/with_limits.hpp"

#include <catch2/catch.hpp>

using namespace tactus;
using Catch::Matchers::Contains;

TEST_CASE ("limits are read with their suffixes, and the other budgets keep their defaults", "[budget]")
{
    const auto read = readLimits ("nodes=20000,memory=2GB,time=15s,file=1.5kB,wires=2k");
    REQUIRE (read);
    CHECK (read->nodes == 20000.0);
    CHECK (read->memory == 2e9);
    CHECK (read->time == 15.0);
    CHECK (read->file == 1500.0);
    CHECK (read->wires == 2000.0);
    CHECK (read->roles == Budgets {}.roles);
    CHECK (readLimits ("")->nodes == Budgets {}.nodes);
}

TEST_CASE ("a wrong limit is refused with what would be right", "[budget]")
{
    const auto refusal = [] (const char* text) {
        const auto read = readLimits (text);
        REQUIRE_FALSE (read);
        CHECK (read.error().id == "limits/value");
        return sentence (read.error());
    };
    CHECK_THAT (refusal ("noodles=3"), Contains ("'noodles'") && Contains ("did you mean 'nodes'?"));
    CHECK_THAT (refusal ("nodes"), Contains ("nodes=200k"));
    for (const auto* wrong : { "nodes=", "nodes=0", "nodes=-1", "nodes=nan", "nodes=inf", "nodes=1e300", "nodes=2KB", "nodes=3 k", "memory=2TB",
                               "time=0s", "time=1h", "nodes=1,=2" })
    {
        INFO (wrong);
        refusal (wrong);
    }
}

TEST_CASE ("a refusal names the budget, the figure and the option that raises it", "[budget]")
{
    const auto m = overBudget ("graph/too_large", &Budgets::nodes, "the graph", 200001.0, "use fewer");
    CHECK (m.text == "the graph takes 200001 nodes or more; the budget `nodes` allows 200000 nodes");
    CHECK (m.remedy == "use fewer, or raise the budget: --limits nodes=400k");
    const auto bytes = overBudget ("x/y", &Budgets::memory, "it", 1.23e9, "use less");
    CHECK (bytes.text == "it takes 1230 MB or more; the budget `memory` allows 450 MB");
    CHECK (bytes.remedy == "use less, or raise the budget: --limits memory=2GB");
    const auto time = overBudget ("x/y", &Budgets::time, "it", 41.23, "use less");
    CHECK (time.text == "it takes 41.3 s or more; the budget `time` allows 5 s");
    CHECK (time.remedy == "use less, or raise the budget: --limits time=50s");
}

TEST_CASE ("a text with too many values is refused at the first value beyond the limit", "[budget]")
{
    const WithLimits limits ("values=5");
    CHECK (readJson ("[1, 2, 3, 4]").messages.empty());
    CHECK (readJson ("[1, 2, 3, 4]").values == 5.0);
    const auto json = readJson ("[1, 2,\n 3, {}, []]");
    REQUIRE (json.messages.size() == 1);
    CHECK (json.messages[0].id == "file/too_large");
    CHECK (json.messages[0].line == 2);
    CHECK_THAT (json.messages[0].remedy, Contains ("--limits values=10"));
}
