// SPDX-License-Identifier: GPL-3.0-or-later
// A monkey test of the window: random actions in random order, with checks after each one. TACTUS_UI_ACTIONS sets the total
// number of actions. TACTUS_UI_SEED runs one seed only and prints each action before it is performed.
#include "support/consistency.hpp"
#include "support/monkey.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <iostream>
#include <mutex>
#include <thread>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::test;

namespace
{
constexpr int usual_actions = 3000, actions_of_a_seed = 500;
constexpr std::size_t reported_actions = 30;

int numberFrom (const char* variable, int otherwise)
{
    const auto* text = std::getenv (variable);
    return text == nullptr ? otherwise : std::stoi (text);
}

/// The last actions. A thread of their own prints them once if nothing happens for a minute, because a test that is ended from outside says nothing.
class Actions
{
public:
    explicit Actions (unsigned s) : seed (s), watching ([this] (const std::stop_token& over) { watch (over); }) {}

    void add (std::string action)
    {
        const std::lock_guard lock (mutex);
        done.push_back (std::move (action));
        if (done.size() > reported_actions) done.pop_front();
        ++count;
    }

    std::string text() const
    {
        const std::lock_guard lock (mutex);
        std::string all = "TACTUS_UI_SEED=" + std::to_string (seed) + " after";
        for (const auto& action : done)
            all += "\n  " + action;
        return all;
    }

private:
    void watch (const std::stop_token& over)
    {
        for (std::size_t before = 0;;)
        {
            std::unique_lock lock (mutex);
            if (changed.wait_for (lock, over, std::chrono::minutes (1), [&] { return over.stop_requested(); })) return;
            if (std::exchange (before, count) != count) continue;
            lock.unlock();
            std::cerr << "nothing happens: " << text() << std::endl;
            return;
        }
    }

    const unsigned seed;
    mutable std::mutex mutex;
    std::condition_variable_any changed;
    std::deque<std::string> done;
    std::size_t count = 1;
    std::jthread watching;   // declared last: it uses the other members
};

void play (unsigned seed, int actions, bool prints)
{
    Actions done (seed);
    Monkey monkey (seed);
    FileAssets assets;
    const auto check = [&] (const std::string& fault) {
        if (! fault.empty()) FAIL (fault << "\n"
                                         << done.text());
    };
    for (int n = 1; n <= actions; ++n)
    {
        if (prints) std::cerr << n << ": " << std::flush;
        const auto& document = monkey.view->document();
        const auto before = valuesInEffect (document.graph());
        const auto names = document.history().names().size(), position = document.history().position();
        const auto* identity = &document;
        const auto action = monkey.act();
        if (prints) std::cerr << action << std::endl;
        done.add (std::to_string (n) + ": " + action);
        const auto& after = monkey.view->document();   // the window may have begun again
        if (&after == identity && after.history().position() == position + 1 && after.history().names().size() <= names + 1)
            check (movedValue (after, before, valuesInEffect (after.graph())));
        if (n % 3 == 0)
        {
            monkey.poll (1);
            for (int i = 0; i < 100 && ! keyboardFault (*monkey.view).empty(); ++i)
                monkey.poll (5);   // after a menu, the window looks after the focus at its next timer call
            check (keyboardFault (*monkey.view));
        }
        if (n % 7 == 0) check (stepFault (monkey.view->document()));
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
