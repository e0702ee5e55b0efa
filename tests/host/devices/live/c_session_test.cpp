// SPDX-License-Identifier: MIT
// The C API of live sessions (tactus_live.h), on simulated devices. tests/guest plays on virtual ones.
#include "support/waiting.hpp"

#include <support/temporary_folder.hpp>
#include <tactus/tactus_live.h>

#include <catch2/catch.hpp>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#if defined(__unix__)
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

using tactus::test::eventually;

namespace
{
struct Free
{
    void operator() (tactus_messages* m) const { tactus_messages_free (m); }
    void operator() (tactus_graph* g) const { tactus_graph_free (g); }
    void operator() (tactus_session* s) const { tactus_session_close (s); }
};
using Messages = std::unique_ptr<tactus_messages, Free>;
using Graph = std::unique_ptr<tactus_graph, Free>;
using Session = std::unique_ptr<tactus_session, Free>;

Messages noMessages() { return Messages { tactus_messages_create() }; }

std::vector<std::string> idsOf (tactus_messages* messages)
{
    std::vector<std::string> ids;
    tactus_message m = TACTUS_MESSAGE;
    for (std::size_t i = 0; tactus_messages_get (messages, i, &m) == TACTUS_OK; ++i)
        ids.emplace_back (m.id);
    return ids;
}

Graph dryWood (tactus_messages* m) { return Graph { tactus_graph_load (TACTUS_SOURCE_DIR "/graphs/dry_wood.json", m) }; }

/// Dry wood under a gesture, recorded.
Session opened (tactus_messages* m, const char* device = "stylus=gesture:circle", const std::function<void (tactus_session_options&)>& change = {})
{
    const auto graph = dryWood (m);
    const char* records[] = { "motor.force" };
    tactus_session_options options = TACTUS_SESSION_OPTIONS;
    options.devices = &device;
    options.device_count = 1;
    options.session = "off";
    options.records = records;
    options.record_count = 1;
    options.buffer_s = 10.0;
    if (change) change (options);
    return Session { tactus_session_open (graph.get(), &options, m) };
}

tactus_status statusOf (const Session& s)
{
    tactus_status status = TACTUS_STATUS;
    REQUIRE (tactus_session_status (s.get(), &status) == TACTUS_OK);
    return status;
}
}   // namespace

TEST_CASE ("a session plays a graph from C, records it and ends by itself", "[live][c_api]")
{
    auto m = noMessages();
    const auto session = opened (m.get(), "stylus=gesture:circle", [] (auto& o) { o.duration_s = 1.0; });
    REQUIRE (session);
    CHECK (idsOf (m.get()).empty());
    CHECK (tactus_session_rate (session.get()) == 4000.0);
    CHECK (std::string (tactus_session_clock (session.get())).empty());
    REQUIRE (tactus_session_start (session.get(), m.get()) == TACTUS_OK);
    CHECK (tactus_session_start (session.get(), m.get()) == TACTUS_MISUSE);
    REQUIRE (eventually ([&] { return statusOf (session).phase == TACTUS_OVER; }));

    REQUIRE (tactus_session_record_count (session.get()) == 3);
    CHECK (std::string (tactus_session_record_name (session.get(), 2)) == "motor.force.z");
    CHECK (std::string (tactus_session_record_unit (session.get(), 2)) == "N");
    std::vector<double> rows (3 * 4000);
    CHECK (tactus_session_collect (session.get(), rows.data(), 4000) > 0);   // a busy computer loses ticks
    CHECK (tactus_session_lost (session.get()) == 0);
    CHECK (statusOf (session).peak_force > 0.0);
    CHECK (tactus_session_stop (session.get(), m.get()) == TACTUS_OK);
}

TEST_CASE ("a session refuses wrong options, each with its id, and opens nothing", "[live][c_api]")
{
    const auto idOf = [] (const char* device, const std::function<void (tactus_session_options&)>& change = {}) {
        auto m = noMessages();
        CHECK_FALSE (opened (m.get(), device, change));
        return idsOf (m.get()).empty() ? std::string() : idsOf (m.get()).back();
    };
    CHECK (idOf ("stylus") == "device/option");
    CHECK (idOf ("stylus=gesture:none") == "device/unknown_gesture");
    CHECK (idOf ("pen=gesture:circle") == "device/unknown_role");
    CHECK (idOf ("stylus=hid:no_such_profile") == "hid/unknown_profile");
    CHECK (idOf ("stylus=gesture:circle", [] (auto& o) { o.session = "/nowhere/session.json"; }) == "session/unreadable");
    CHECK (idOf ("stylus=gesture:circle", [] (auto& o) { o.clock = "stylus"; }) == "run/no_clock");
    CHECK (idOf ("stylus=gesture:circle", [] (auto& o) { o.rate_hz = -1.0; }) == "api/value");
    CHECK (idOf ("stylus=gesture:circle", [] (auto& o) { o.log = "/nowhere/log.jsonl"; }) == "output/unwritable");
    static const char* sets[] = { "drag.mu" };
    CHECK (idOf ("stylus=gesture:circle", [] (auto& o) { o.sets = sets, o.set_count = 1; }) == "param/no_value");
}

TEST_CASE ("a running session takes parameters, hits, controls, probes and edits", "[live][c_api]")
{
    auto m = noMessages();
    const auto session = opened (m.get());
    REQUIRE (session);
    REQUIRE (tactus_session_start (session.get(), m.get()) == TACTUS_OK);
    CHECK (tactus_session_set (session.get(), "drag.mu", "0.2", m.get()) == TACTUS_OK);
    CHECK (tactus_session_set (session.get(), "drag.nothing", "0.2", m.get()) == TACTUS_FAILED);
    CHECK (tactus_session_turn (session.get(), "roughness", 0.9, m.get()) == TACTUS_OK);
    CHECK (tactus_session_turn (session.get(), "nothing", 0.9, m.get()) == TACTUS_FAILED);
    CHECK (tactus_session_hit (session.get(), "drag.force", 1.0, m.get()) == TACTUS_FAILED);

    const char* ports[] = { "hand.position", "drag.state" };
    REQUIRE (tactus_session_probe (session.get(), ports, 2, m.get()) == TACTUS_OK);
    REQUIRE (tactus_session_probe_count (session.get()) == 4);
    CHECK (std::string (tactus_session_probe_name (session.get(), 3)) == "drag.state");
    std::vector<double> values (4);
    CHECK (eventually ([&] { return tactus_session_probed (session.get(), values.data(), 4) == TACTUS_OK && std::abs (values[0]) > 0.0; }));
    std::vector<double> rows (4 * 100);
    std::vector<std::uint64_t> ticks (100);
    REQUIRE (eventually ([&] { return tactus_session_collect_probes (session.get(), ticks.data(), rows.data(), 100) > 1; }));
    CHECK (ticks[1] == ticks[0] + 4);   // 1000 times a second at 4 kHz
    CHECK (tactus_session_lost_probes (session.get()) == 0);
    const char* nowhere[] = { "nothing.out" };
    CHECK (tactus_session_probe (session.get(), nowhere, 1, m.get()) == TACTUS_FAILED);
    CHECK (tactus_session_probe_count (session.get()) == 4);

    auto edited = dryWood (m.get());
    REQUIRE (tactus_graph_set_param (edited.get(), "", "drag", "mu", "0.7", m.get()) == TACTUS_OK);
    CHECK (tactus_session_edit (session.get(), edited.get(), m.get()) == TACTUS_OK);
    CHECK (tactus_graph_add_node (edited.get(), "", "rub", "no.such_node", nullptr) == TACTUS_FAILED);
    char* const whole = tactus_graph_text (edited.get());
    std::string text (whole);
    tactus_text_free (whole);
    const std::string type = "friction.elasto_plastic";
    text.replace (text.find (type), type.size(), "no.such_node");
    const std::unique_ptr<tactus_graph, decltype (&tactus_graph_free)> broken { tactus_graph_parse (text.data(), text.size(), nullptr, m.get()),
                                                                                tactus_graph_free };
    REQUIRE (broken);   // a file may have nodes of types that are not here
    tactus_messages_clear (m.get());
    CHECK (tactus_session_edit (session.get(), broken.get(), m.get()) == TACTUS_FAILED);
    CHECK (tactus_messages_have_errors (m.get()) == 1);
    CHECK (statusOf (session).phase == TACTUS_RUNNING);
}

TEST_CASE ("an emergency stop of a session brings the force to zero, and only a late rearm ends it", "[live][c_api][safety]")
{
    auto m = noMessages();
    const auto session = opened (m.get());
    REQUIRE (session);
    REQUIRE (tactus_session_start (session.get(), m.get()) == TACTUS_OK);
    REQUIRE (eventually ([&] { return statusOf (session).force > 0.0; }));
    REQUIRE (eventually ([&] {   // a busy computer may take longer than a second from one to the other
        REQUIRE (tactus_session_emergency_stop (session.get()) == TACTUS_OK);
        return tactus_session_rearm (session.get(), m.get()) == TACTUS_FAILED;
    }));
    CHECK (idsOf (m.get()).back() == "run/rearm_too_early");
    CHECK (eventually ([&] { return statusOf (session).force == 0.0 && statusOf (session).is_emergency == 1; }));
    tactus_messages_clear (m.get());
    CHECK (eventually ([&] { return tactus_session_events (session.get(), m.get()) > 0; }));
    CHECK (idsOf (m.get()).front() == "run/guard");
    CHECK (eventually ([&] { return tactus_session_rearm (session.get(), nullptr) == TACTUS_OK; }));
    CHECK (eventually ([&] { return statusOf (session).force > 0.0; }));
}

TEST_CASE ("an emergency stop before the first tick holds from the first tick on", "[live][c_api][safety]")
{
    auto m = noMessages();
    const auto session = opened (m.get());
    REQUIRE (session);
    REQUIRE (tactus_session_emergency_stop (session.get()) == TACTUS_OK);
    REQUIRE (tactus_session_start (session.get(), m.get()) == TACTUS_OK);
    REQUIRE (eventually ([&] { return statusOf (session).ticks > 2000; }));
    CHECK (statusOf (session).peak_force == 0.0);
}

TEST_CASE ("two sessions of one process play at the same time", "[live][c_api]")
{
    auto m = noMessages();
    const auto one = opened (m.get()), other = opened (m.get(), "stylus=gesture:stroke");
    REQUIRE (one);
    REQUIRE (other);
    CHECK (tactus_session_start (one.get(), m.get()) == TACTUS_OK);
    CHECK (tactus_session_start (other.get(), m.get()) == TACTUS_OK);
    CHECK (eventually ([&] { return statusOf (one).force > 0.0 && statusOf (other).force > 0.0; }));
    CHECK (tactus_session_emergency_stop (one.get()) == TACTUS_OK);
    CHECK (eventually ([&] { return statusOf (one).force == 0.0; }));
    CHECK (eventually ([&] { return statusOf (other).force > 0.0; }));
}

TEST_CASE ("a session without handles or after its end is a misuse, and crashes nothing", "[live][c_api]")
{
    CHECK (tactus_session_open (nullptr, nullptr, nullptr) == nullptr);
    CHECK (tactus_session_start (nullptr, nullptr) == TACTUS_MISUSE);
    CHECK (tactus_session_stop (nullptr, nullptr) == TACTUS_MISUSE);
    CHECK (tactus_session_set (nullptr, "a.b", "1", nullptr) == TACTUS_MISUSE);
    CHECK (tactus_session_edit (nullptr, nullptr, nullptr) == TACTUS_MISUSE);
    CHECK (tactus_session_collect (nullptr, nullptr, 3) == 0);
    CHECK (tactus_session_health_count (nullptr) == 0);
    CHECK (tactus_session_rate (nullptr) == 0.0);
    tactus_session_close (nullptr);

    auto m = noMessages();
    const auto session = opened (m.get());
    REQUIRE (session);
    CHECK (tactus_session_stop (session.get(), m.get()) == TACTUS_OK);   // never started
    CHECK (tactus_session_set (session.get(), nullptr, nullptr, m.get()) == TACTUS_FAILED);
    CHECK (tactus_session_probed (session.get(), nullptr, 0) == TACTUS_MISUSE);
    tactus_status status {};
    CHECK (tactus_session_status (session.get(), &status) == TACTUS_MISUSE);
    CHECK (std::string (tactus_last_misuse()).find ("TACTUS_STATUS") != std::string::npos);
    const auto graph = dryWood (m.get());
    const tactus_session_options cleared {};
    CHECK (tactus_session_open (graph.get(), &cleared, m.get()) == nullptr);
    CHECK (idsOf (m.get()).back() == "api/struct");
}

namespace
{
/// Reads no asset until the run is over: an edit that takes long.
struct Slow
{
    static tactus_asset_answer read (void* self, tactus_asset_kind, const char*, tactus_asset*)
    {
        auto& slow = *static_cast<Slow*> (self);
        slow.is_reading = true;
        slow.was_over = eventually ([&] { return statusOf (*slow.session).phase == TACTUS_OVER; });
        return TACTUS_ASSET_REFUSED;
    }

    const Session* session = nullptr;
    std::atomic<bool> is_reading { false }, was_over { false };
};
}   // namespace

TEST_CASE ("a stop of a session does not wait for a call of another thread", "[live][c_api][safety]")
{
    auto m = noMessages(), of_edit = noMessages();
    Slow slow;
    const auto session = opened (m.get(), "stylus=gesture:circle", [&] (auto& o) {
        o.assets = Slow::read;
        o.asset_context = &slow;
    });
    REQUIRE (session);
    slow.session = &session;
    REQUIRE (tactus_session_start (session.get(), m.get()) == TACTUS_OK);
    auto edited = dryWood (m.get());
    REQUIRE (tactus_graph_add_node (edited.get(), "", "map", "texture.height_map", m.get()) == TACTUS_OK);
    REQUIRE (tactus_graph_set_setting (edited.get(), "", "map", "map", R"({"image": "map.png", "pitch": "1 mm", "height": "1 mm"})", m.get()) == TACTUS_OK);
    std::jthread editing ([&] { tactus_session_edit (session.get(), edited.get(), of_edit.get()); });
    REQUIRE (eventually ([&] { return slow.is_reading.load(); }));
    CHECK (tactus_session_stop (session.get(), m.get()) == TACTUS_OK);
    CHECK (slow.was_over);
}

TEST_CASE ("what is stopped before its start does not play", "[live][c_api][safety]")
{
    auto m = noMessages();
    const auto session = opened (m.get());
    REQUIRE (session);
    REQUIRE (tactus_session_stop (session.get(), m.get()) == TACTUS_OK);
    REQUIRE (tactus_session_start (session.get(), m.get()) == TACTUS_OK);
    CHECK (eventually ([&] { return statusOf (session).phase == TACTUS_OVER; }));
    CHECK (statusOf (session).peak_force == 0.0);
}

#if defined(__unix__)
TEST_CASE ("the child of a fork cannot use the session of its parent", "[live][c_api][platform]")
{
    auto m = noMessages();
    const auto session = opened (m.get());
    REQUIRE (session);
    REQUIRE (tactus_session_start (session.get(), m.get()) == TACTUS_OK);
    const auto child = ::fork();
    if (child == 0)
    {
        tactus_status status = TACTUS_STATUS;
        const bool refused = tactus_session_set (session.get(), "drag.mu", "0.1", nullptr) == TACTUS_MISUSE
                             && tactus_session_emergency_stop (session.get()) == TACTUS_MISUSE
                             && tactus_session_status (session.get(), &status) == TACTUS_MISUSE;
        ::_exit (refused ? 0 : 1);
    }
    int status = 0;
    REQUIRE (::waitpid (child, &status, 0) == child);
    CHECK (WIFEXITED (status));
    CHECK (WEXITSTATUS (status) == 0);
    CHECK (eventually ([&] { return statusOf (session).force > 0.0; }));   // the parent plays on
}
#endif

#if defined(__linux__)
TEST_CASE ("a session stops when the main thread has ended, although another one goes on", "[live][c_api][platform][safety]")
{
    const auto child = ::fork();   // its only thread is its main thread
    if (child == 0)
    {
        auto m = noMessages();
        auto session = opened (m.get());
        if (! session || tactus_session_start (session.get(), m.get()) != TACTUS_OK) ::_exit (2);
        if (! eventually ([&] { return statusOf (session).force > 0.0; })) ::_exit (3);
        std::thread ([s = session.release()] {
            tactus_status status = TACTUS_STATUS;
            ::_exit (
                eventually ([&] { return tactus_session_status (s, &status) == TACTUS_OK && status.phase == TACTUS_OVER && status.force == 0.0; })
                    ? 0
                    : 1);
        }).detach();
        ::syscall (SYS_exit, 0);   // as pthread_exit, which would unwind the test
    }
    int status = 0;
    REQUIRE (::waitpid (child, &status, 0) == child);
    REQUIRE (WIFEXITED (status));
    CHECK (WEXITSTATUS (status) == 0);
}
#endif
