// SPDX-License-Identifier: MIT
// Edits a run while it ticks, as docs/library.md and docs/devices.md say: with a clock and a device of its own, Run::start and Run::edit. This
// program and the sources of the library that it needs are compiled with TSan, which ends it at the first data race.
//
// It waits for ticks and not for a time, so a slow computer only makes it take longer.
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/nodes/deform/plane.hpp>
#include <tactus/nodes/device/force.hpp>
#include <tactus/nodes/device/position.hpp>
#include <tactus/nodes/signal/add.hpp>
#include <tactus/nodes/signal/constant.hpp>
#include <tactus/nodes/signal/gain.hpp>
#include <tactus/nodes/vibration/modal.hpp>
#include <tactus/run/run.hpp>

#include <atomic>
#include <cstdio>
#include <thread>

using namespace tactus;

namespace
{
/// Ticks whenever the other threads let it, and counts.
class OwnClock final : public TickClock
{
public:
    void drive (Ticked& ticked) noexcept override
    {
        for (; ticked.tick (0.0); std::this_thread::yield())
            count.fetch_add (1, std::memory_order_relaxed);   // relaxed, so that it orders no other access
        is_over.store (true, std::memory_order_relaxed);
    }

    bool isRealTime() const noexcept override { return false; }

    /// Waits for this many ticks. False if there are no more.
    bool wait (std::uint64_t ticks) const
    {
        for (const auto until = count.load (std::memory_order_relaxed) + ticks; count.load (std::memory_order_relaxed) < until; std::this_thread::yield())
            if (is_over.load (std::memory_order_relaxed)) return false;
        return true;
    }

private:
    std::atomic<std::uint64_t> count = 0;
    std::atomic<bool> is_over = false;
};

/// A tool that moves up and down through the wall.
struct Tool final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override
    {
        height = height > -1e-3 ? height - 1e-5 : 1e-3;
        return { .position = { 0.0, 0.0, height } };
    }
    void write (const Effort& e) noexcept override { felt = felt || e.force != Vec3::Zero(); }

    double height = 1e-3;
    bool felt = false;   // read after the run
};

struct Editor
{
    graph::History history { graph::Graph {} };

    bool perform (graph::Command command)
    {
        auto done = history.perform (std::move (command));
        if (! done) std::fprintf (stderr, "%s\n", describe (done.error()).c_str());
        return bool (done);
    }

    bool add (const char* name, const char* type, const char* role = "")
    {
        graph::Node node;
        node.name = name;
        node.type = type;
        node.role = role;
        return perform (graph::AddNode { "", node });
    }

    bool wire (const char* text) { return perform (graph::AddWire { "", *graph::parseWire (text) }); }

    bool cut (const char* text)
    {
        const auto gone = *graph::parseWire (text);
        for (const auto& w : history.graph().root.wires)
            if (graph::toText (w) == graph::toText (gone)) return perform (graph::RemoveWire { "", w.id });
        return false;
    }

    bool build()
    {
        return add ("hand", "device.position", "pen") && add ("wall", "deform.plane") && add ("push", "signal.constant") && add ("one", "signal.constant")
               && add ("half", "signal.gain") && add ("all", "signal.add") && add ("ring", "vibration.modal") && add ("motor", "device.force", "pen")
               && wire ("hand.position -> wall.position") && wire ("wall.force -> motor.force") && wire ("push.out -> half.in")
               && wire ("half.out -> all.in[0]") && wire ("all.out -> motor.force.x");
    }

    /// The k-th edit: wires that come and go, a node that comes and goes, undo and redo.
    bool edit (int k)
    {
        switch (k % 8)
        {
        case 0:
            return wire ("push.out -> all.in[1]");
        case 1:
            return wire ("one.out -> half.gain");
        case 2:
            return cut ("push.out -> all.in[1]");
        case 3:
            return history.undo();
        case 4:
            return history.redo();
        case 5:
            return cut ("one.out -> half.gain");
        case 6:
            return add ("more", "signal.gain") && wire ("all.out -> more.in");
        default:
            return history.undo() && history.undo();
        }
    }
};
}   // namespace

/// In place of that of the library, which has all nodes.
const Catalogue& tactus::catalogue()
{
    static const Catalogue types { { describe<nodes::Plane>(), describe<nodes::DeviceForce>(), describe<nodes::DevicePosition>(), describe<nodes::SignalAdd>(),
                                     describe<nodes::SignalConstant>(), describe<nodes::SignalGain>(), describe<nodes::Modal>() } };
    return types;
}

int main()
{
    Tool* tool = nullptr;
    const auto openDevice = [&tool] (auto&&...) {
        auto made = std::make_unique<Tool>();
        tool = made.get();
        return Run::RoleDevice { std::move (made), { .max_force = 3.0 } };
    };

    Editor editor;
    if (! editor.build()) return 1;
    OwnClock clock;
    Run run { catalogue(), {}, openDevice, Run::Queries::on_thread };
    auto messages = run.load (editor.history.graph());
    if (! hasErrors (messages)) run.openDevices (editor.history.graph(), messages);
    for (const auto& m : messages)
        std::fprintf (stderr, "%s\n", describe (m).c_str());
    if (hasErrors (messages)) return 1;

    run.start (clock);
    constexpr int edits = 400;
    for (int k = 0; k < edits; ++k)
    {
        if (! editor.edit (k)) return 1;
        auto edit = run.edit (editor.history.graph());
        if (edit.plan() == nullptr)
        {
            for (const auto& m : edit.messages())
                std::fprintf (stderr, "edit %d: %s\n", k, describe (m).c_str());
            return 1;
        }
        edit.commit();
        if (const auto gain = run.engine().param ("half.gain")) run.engine().set (*gain, 0.5 + 0.001 * (k % 100));
        if (const auto hits = run.engine().hits ("ring.hit"))
            for (const auto& hit : *hits)
                run.engine().strike (hit, 0.1);
        run.poll();
        if (k % 4 != 3 && ! clock.wait (3)) return 1;   // after every fourth edit, the next one is made at once, and may withdraw the plan
    }
    run.end();
    std::printf ("%llu ticks, %d edits\n", static_cast<unsigned long long> (run.live().status().ticks), edits);
    return tool->felt ? 0 : 1;
}
