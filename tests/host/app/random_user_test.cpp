// SPDX-License-Identifier: MIT
// A monkey test of the window: random actions in random order, with checks after each one. TACTUS_UI_ACTIONS sets the total
// number of actions. TACTUS_UI_SEED runs one seed only and prints each action before it is performed.
#include "support/consistency.hpp"
#include "support/monkey.hpp"

#include <deque>
#include <iostream>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::test;

namespace
{
constexpr int usual_actions = 10000, actions_of_a_seed = 500;
constexpr std::size_t reported_actions = 30;

int numberFrom (const char* variable, int otherwise)
{
    const auto* text = std::getenv (variable);
    return text == nullptr ? otherwise : std::atoi (text);
}

void play (unsigned seed, int actions, bool prints)
{
    Monkey monkey (seed);
    FileAssets assets;
    std::deque<std::string> done;
    const auto check = [&] (const std::string& fault) {
        if (fault.empty()) return;
        std::string log;
        for (const auto& action : done)
            log += "\n  " + action;
        FAIL ("TACTUS_UI_SEED=" << seed << ": " << fault << "\nafter" << log);
    };
    for (int n = 1; n <= actions; ++n)
    {
        if (prints) std::cerr << n << ": " << std::flush;
        done.push_back (std::to_string (n) + ": " + monkey.act());
        if (prints) std::cerr << done.back().substr (done.back().find (' ') + 1) << std::endl;
        if (done.size() > reported_actions) done.pop_front();
        if (n % 3 == 0) monkey.attend (1);
        check (disagreement (*monkey.view));
        if (n % 20 == 0) check (disagreementWithCompile (*monkey.view, assets));
        if (n % 50 == 0) monkey.paint();
        if (n % 100 == 0) check (instability (monkey.view->document().graph()));
    }
    monkey.settle();
    check (historyFault (monkey.view->document()));
    check (disagreement (*monkey.view));
    check (disagreementWithCompile (*monkey.view, assets));
}
}   // namespace

TEST_CASE ("graph, plan and view stay consistent under random user actions", "[app][random]")
{
    const int all = numberFrom ("TACTUS_UI_ACTIONS", usual_actions);
    if (const int seed = numberFrom ("TACTUS_UI_SEED", -1); seed >= 0) return play (static_cast<unsigned> (seed), std::min (all, actions_of_a_seed), true);
    for (int seed = 0; seed * actions_of_a_seed < all; ++seed)
        play (static_cast<unsigned> (seed), std::min (actions_of_a_seed, all - seed * actions_of_a_seed), false);
}
