// SPDX-License-Identifier: MIT
#pragma once

#include "offered_fake.hpp"

#include <tactus/text/caught.hpp>
#include <tactus/text/number_text.hpp>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>

namespace tactus::host
{

/// A fake of a maker's library, with an arm in shared memory that a simulated hand moves. `Kind` has
///
///     Memory                                        the type of the shared memory, with `arms`
///     name, what                                    of the fake, and of the arm
///     stepped                                       of the arm's is_stepped
///     per_m                                         units of the library in a metre
///     Vec3 fromTactus (const Vec3&), toTactus       the axes
///     Vec3 force (const Memory::Arm&)               on the tool now, in the axes of the library
///     std::uint64_t pushes (const Memory::Arm&)     forces so far
///     std::string environment (library, memory)     in which a driver finds both, as a shell takes it
///     void fail (Memory&, std::string_view fault)
template <typename Kind>
class FakeLibrary final : public OfferedFake
{
public:
    static Result<std::unique_ptr<OfferedFake>> make (OfferedFakeParts parts)
    {
        auto made = std::make_unique<FakeLibrary> (std::move (parts));
        if (made->memory != nullptr) return std::unique_ptr<OfferedFake> (std::move (made));
        return Message::error ("fake/library", Kind::name, "the fake of the maker's library is not there, or has no memory",
                               "install the whole of Tactus, or build its target fake_libraries");
    }

    explicit FakeLibrary (OfferedFakeParts parts)
        : hand (std::move (parts.hand)), library (parts.libraries / Kind::name), file (parts.private_folder / "arms")
    {
        if (parts.private_folder.empty() || ! std::filesystem::is_directory (library)) return;
        const int opened = ::open (file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        void* at = MAP_FAILED;
        if (opened >= 0 && ::ftruncate (opened, sizeof (Memory)) == 0) at = ::mmap (nullptr, sizeof (Memory), PROT_READ | PROT_WRITE, MAP_SHARED, opened, 0);
        if (opened >= 0) ::close (opened);
        if (at == MAP_FAILED) return;
        memory = static_cast<Memory*> (at);
        memory->arms[0].is_stepped = Kind::stepped;
        hand->prepare (1e-3);
        mover = std::thread ([this] { static_cast<void> (caught ("the fake arm", [this] { move(); })); });
    }
    ~FakeLibrary() override
    {
        ending = true;
        if (mover.joinable()) mover.join();
        if (memory != nullptr) ::munmap (memory, sizeof (Memory));
    }
    FakeLibrary (const FakeLibrary&) = delete;
    FakeLibrary& operator= (const FakeLibrary&) = delete;

    std::string where() const override
    {
        return std::string ("a fake ") + Kind::what + " is there, behind a fake of its maker's library; play on it:\n"
               + Kind::environment (library.string(), file.string()) + " tactus play GRAPH --device ROLE=" + Kind::name;
    }

    std::string heard() const override
    {
        return std::to_string (Kind::pushes (memory->arms[0])) + " forces heard, of at most " + numberText (largest_force) + " N";
    }

    void fail (std::string_view fault) override { Kind::fail (*memory, fault); }

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
    const std::filesystem::path library, file;
    Memory* memory = nullptr;
    std::atomic<double> largest_force = 0.0;
    std::atomic<bool> ending = false;
    std::thread mover;
};

}   // namespace tactus::host
