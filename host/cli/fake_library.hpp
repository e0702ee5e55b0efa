// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/platform/preset_folder.hpp>
#include <host/base/platform/private_folder.hpp>
#include <host/drivers/forcedimension/fake_drd.hpp>
#include <host/drivers/openhaptics/fake_hd.hpp>
#include <tactus/node/device.hpp>
#include <tactus/text/caught.hpp>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace tactus::host
{

/// A fake of a maker's library, with an arm in shared memory that a simulated hand moves. `Kind` says which library, and what its axes are.
template <typename Kind>
class FakeLibrary
{
public:
    enum class Fault
    {
        none,
        silent,      ///< a call of the library does not return
        away,        ///< the arm is unplugged
        forgetful,   ///< it does not know its position
        off          ///< its forces go off, or its motors are warm
    };

    explicit FakeLibrary (std::unique_ptr<Device> h) : hand (std::move (h)), library (shipped ({ Kind::place, "../" + std::string (Kind::place) }))
    {
        const int file = folder.empty() ? -1 : ::open ((folder / "arms").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        void* at = MAP_FAILED;
        if (file >= 0 && ::ftruncate (file, sizeof (Memory)) == 0) at = ::mmap (nullptr, sizeof (Memory), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        if (file >= 0) ::close (file);
        if (at == MAP_FAILED || library.empty()) return;
        memory = static_cast<Memory*> (at);
        memory->arms[0].is_stepped = Kind::stepped;
        hand->prepare (1e-3);
        mover = std::thread ([this] { static_cast<void> (caught ("the fake arm", [this] { move(); })); });
    }
    ~FakeLibrary()
    {
        ending = true;
        if (mover.joinable()) mover.join();
        if (memory != nullptr) ::munmap (memory, sizeof (Memory));
        std::error_code failed;
        if (! folder.empty()) std::filesystem::remove_all (folder, failed);
    }
    FakeLibrary (const FakeLibrary&) = delete;
    FakeLibrary& operator= (const FakeLibrary&) = delete;

    bool isThere() const { return memory != nullptr; }

    /// The environment in which a driver finds this library, as a shell takes it.
    std::string environment() const { return Kind::environment (library.string(), (folder / "arms").string()); }

    void fail (Fault fault) { Kind::fail (*memory, fault); }

    std::uint64_t pushes() const { return Kind::pushes (memory->arms[0]); }
    std::atomic<double> largest_force = 0.0;

private:
    using Memory = typename Kind::Memory;

    /// Each ms, the tool goes where the hand is, and the hand feels the force.
    void move()
    {
        auto& arm = memory->arms[0];
        for (auto due = std::chrono::steady_clock::now(); ! ending; due = std::max (due, std::chrono::steady_clock::now() - std::chrono::milliseconds (100)))
        {
            const auto reading = hand->read();
            const auto place = Kind::fromTactus (reading.position);
            for (int i = 0; i < 3; ++i)
                arm.target[static_cast<std::size_t> (i)] = Kind::per_m * place[i];
            ++arm.step;
            Effort effort;
            effort.force = Kind::toTactus (Kind::force (arm));
            if (effort.force.norm() > largest_force) largest_force = effort.force.norm();
            hand->write (effort);
            due += std::chrono::milliseconds (1);
            std::this_thread::sleep_until (due);
        }
    }

    std::unique_ptr<Device> hand;
    const std::filesystem::path library, folder = privateFolder ("tactus-fake-arm");
    Memory* memory = nullptr;
    std::atomic<bool> ending = false;
    std::thread mover;
};

/// The library of Force Dimension: x towards the person, y to the right, in m.
struct FakeForceDimension
{
    using Memory = FakeArms;
    static constexpr const char* place = "lib/tactus/fakes/forcedimension";
    static constexpr int stepped = 1;
    static constexpr double per_m = 1.0;
    static Vec3 fromTactus (const Vec3& v) { return { -v.y(), v.x(), v.z() }; }
    static Vec3 toTactus (const Vec3& v) { return { v.y(), -v.x(), v.z() }; }
    static Vec3 force (const FakeArms::Arm& arm)
    {
        const auto now = std::chrono::steady_clock::now().time_since_epoch();
        const auto ns = std::chrono::duration_cast<std::chrono::nanoseconds> (now).count();
        return { FakeArms::forceAt (arm, ns, 0), FakeArms::forceAt (arm, ns, 1), FakeArms::forceAt (arm, ns, 2) };
    }
    static std::uint64_t pushes (const FakeArms::Arm& arm) { return arm.forces; }
    static std::string environment (const std::string& library, const std::string& memory)
    {
        return "FDSDK='" + library + "' TACTUS_FAKE_DRD='" + memory + "'";
    }

    template <typename Fault>
    static void fail (FakeArms& all, Fault fault)
    {
        auto& arm = all.arms[0];
        arm.read_stall_ms = fault == Fault::silent ? -1 : 0;
        arm.is_unplugged = fault == Fault::away ? 1 : 0;
        if (fault == Fault::off) arm.off_cause = 2;
        if (arm.is_open != 0) arm.is_calibrated = fault == Fault::forgetful ? 0 : 1;
    }
};

/// The library of OpenHaptics: x to the right, y up, z towards the person, in mm.
struct FakeOpenHaptics
{
    using Memory = FakeTouches;
    static constexpr const char* place = "lib/tactus/fakes/openhaptics";
    static constexpr int stepped = 2;
    static constexpr double per_m = 1e3;
    static Vec3 fromTactus (const Vec3& v) { return { v.x(), v.z(), -v.y() }; }
    static Vec3 toTactus (const Vec3& v) { return { v.x(), -v.z(), v.y() }; }
    static Vec3 force (const FakeTouches::Arm& arm)
    {
        if (arm.is_open == 0) return Vec3::Zero();
        return { arm.force[0], arm.force[1], arm.force[2] };
    }
    static std::uint64_t pushes (const FakeTouches::Arm& arm) { return arm.frames; }
    static std::string environment (const std::string& library, const std::string& memory)
    {
        return "LD_LIBRARY_PATH='" + library + "' TACTUS_FAKE_HD='" + memory + "'";
    }

    template <typename Fault>
    static void fail (FakeTouches& all, Fault fault)
    {
        auto& arm = all.arms[0];
        all.stall_ms = fault == Fault::silent ? -1 : 0;
        arm.is_unplugged = fault == Fault::away ? 1 : 0;
        arm.calibration = fault == Fault::forgetful ? 2 : 0;
        arm.lasting_error = fault == Fault::off ? 0x200 : 0;
    }
};

}   // namespace tactus::host
