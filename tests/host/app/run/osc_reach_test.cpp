// SPDX-License-Identifier: MIT
#include "../support/canvas_rig.hpp"

#include <host/app/run/osc_reach.hpp>

#include <catch2/catch.hpp>

#include <random>
#include <thread>

using namespace tactus;
using namespace tactus::host;
using juce::OSCMessage;
using test::CanvasRig;
using namespace std::chrono_literals;

namespace
{
/// A window's run, and a program that reaches it.
struct Reached
{
    explicit Reached (const char* preset) : rig (CanvasRig::preset (preset)) {}

    CanvasRig rig;
    Performance performance { rig.document, catalogue() };
    OscReach reach { std::move (*OscPort::open (0)), performance, rig.document, { [this]
                                                                                  { performance.start ({}); },
                                                                                  [this]
                                                                                  { performance.stop(); } } };
    std::unique_ptr<OscPort> other = std::move (*OscPort::open (0));

    template <typename F>
    bool until (F&& isSo)
    {
        const auto end = std::chrono::steady_clock::now() + 20s;
        while (! isSo() && std::chrono::steady_clock::now() < end)
        {
            performance.attend();
            reach.attend();
            std::this_thread::sleep_for (2ms);
        }
        return isSo();
    }

    template <typename... Args>
    OSCMessage ask (const char* address, Args... args)
    {
        other->send (reach.port(), OSCMessage (address, args...));
        std::optional<OSCMessage> answer;
        REQUIRE (until ([&]
                        { return answer || (answer = other->next()); }));
        return *answer;
    }

    std::string text (const OSCMessage& m, int i) { return m[i].getString().toStdString(); }
    int me() const { return other->number(); }
};

bool isError (const OSCMessage& m) { return m.getAddressPattern().toString() == "/tactus/error"; }
}   // namespace

TEST_CASE ("what another program turns in a window is felt, is seen, and is one step of undo", "[app][osc]")
{
    Reached r { "dry_wood" };
    CHECK (r.text (r.ask ("/tactus/param", juce::String ("drag.mu"), 0.3f, r.me()), 2) == "run/stopped");
    CHECK_FALSE (isError (r.ask ("/tactus/start", r.me())));
    REQUIRE (r.until ([&]
                      { return r.performance.isRunning(); }));

    const auto before = r.rig.document.history().position();
    CHECK_FALSE (isError (r.ask ("/tactus/param", juce::String ("board.stiffness"), juce::String ("1.5 N/mm"), r.me())));
    for (int i = 0; i <= 10; ++i)
        r.ask ("/tactus/control", juce::String ("roughness"), 0.1f * static_cast<float> (i), r.me());
    CHECK (r.rig.document.history().position() == before + 1);
    CHECK (r.rig.document.graph().root.find ("board")->params.at ("stiffness") == Json ("1.5 N/mm"));
    CHECK (r.rig.document.graph().controls.front().value == Approx (1.0));
    CHECK (r.performance.messages().empty());
    r.rig.document.undo();
    CHECK (r.rig.document.graph().controls.front().value == Approx (0.5));

    const auto here = r.rig.document.history().position();
    CHECK (r.text (r.ask ("/tactus/param", juce::String ("drag.nu"), 0.3f, r.me()), 2) == "param/unknown");
    CHECK (r.text (r.ask ("/tactus/param", juce::String ("drag.mu"), juce::String ("3 mm"), r.me()), 2) == "param/unit");
    CHECK (r.rig.document.history().position() == here);

    r.other->send (r.reach.port(), OSCMessage ("/tactus/stop"));
    CHECK (r.until ([&]
                    { return ! r.performance.isRunning(); }));
}

TEST_CASE ("another program sees what stands on a port of a window, also after an edit, until the port is gone", "[app][osc]")
{
    Reached r { "dry_wood" };
    r.performance.start ({});
    const auto done = r.ask ("/tactus/probe", juce::String ("drag.force"), r.me(), 500.0f, 30.0f);
    REQUIRE_FALSE (isError (done));
    CHECK (done.size() == 6);
    CHECK (r.text (done, 3) == "drag.force.x");
    const auto next = [&]
    {
        std::optional<OSCMessage> value;
        REQUIRE (r.until ([&]
                          { return value || (value = r.other->next()); }));
        return *value;
    };
    const auto first = next();
    CHECK (first.getAddressPattern().toString() == "/tactus/value");
    CHECK (first.size() == 5);
    CHECK (next()[1].getInt32() > first[1].getInt32());

    r.rig.document.perform (graph::SetParam { "", "drag", "mu", Json (0.3) });
    CHECK (next().getAddressPattern().toString() == "/tactus/value");
    r.rig.document.perform (graph::RemoveNode { "", "drag" });
    std::optional<OSCMessage> ended;
    CHECK (r.until ([&]
                    {
        while (auto m = r.other->next())
            if (isError (*m)) ended = m;
        return ended.has_value(); }));
}

TEST_CASE ("another program waits for an edge in a window", "[app][osc]")
{
    Reached r { "dry_wood" };
    r.performance.start ({});
    REQUIRE_FALSE (isError (r.ask ("/tactus/trigger", juce::String ("drag.force"), r.me(), juce::String ("board.depth"), 1e-4f, juce::String ("rising"), 10, 20, 30.0f)));
    std::size_t numbers = 0;
    CHECK (r.until ([&]
                    {
        while (auto m = r.other->next())
            if (m->getAddressPattern().toString() == "/tactus/capture") numbers += static_cast<std::size_t> (m->size()) - 4;
        return numbers == 31 * 3; }));
    CHECK (isError (r.ask ("/tactus/trigger", juce::String ("drag.force"), r.me(), juce::String ("drag.force"), 0.5f)));
    CHECK_FALSE (r.performance.isCapturing());
}

TEST_CASE ("whatever is sent to a window does it no harm", "[app][osc]")
{
    Reached r { "dry_wood" };
    r.performance.start ({});
    REQUIRE (r.until ([&]
                      { return r.performance.isRunning(); }));
    std::mt19937 dice { 5 };
    juce::DatagramSocket socket;
    for (int i = 0; i < 20000; ++i)
    {
        std::string bytes (dice() % 200, ' ');
        for (auto& b : bytes)
            b = static_cast<char> (dice());
        if (i % 3 == 0) bytes.insert (0, std::string ("/tactus/param\0\0\0,sf\0", 20));
        if (i % 7 == 0) bytes.insert (0, std::string ("#bundle\0\0\0\0\0\0\0\0\1", 16));
        socket.write ("127.0.0.1", r.reach.port(), bytes.data(), static_cast<int> (bytes.size()));
        if (i % 500 == 0) r.reach.attend();
    }
    std::optional<OSCMessage> status;   // what does not fit into the queue is dropped
    CHECK (r.until ([&]
                    {
        if (! status) r.other->send (r.reach.port(), OSCMessage ("/tactus/status", r.me()));
        return status || (status = r.other->next()); }));
    CHECK (r.text (*status, 0) == "Dry wood");
    CHECK (r.performance.isRunning());
    CHECK (r.performance.messages().empty());
}
