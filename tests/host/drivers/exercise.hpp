// SPDX-License-Identifier: MIT
#pragma once

#include "support/temporary_folder.hpp"

#include <tactus/tactus_device.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

namespace tactus::test
{

/// Counts what is wrong, and says it.
void expect (bool is_so, const std::string& what);

/// A use of a device, from `open` to `close`.
struct Use
{
    const char* what;
    int readings = 200;                      // until it ends
    std::function<void()> disturb = [] {};   // when half of them have come
    std::function<bool()> is_seen = {};      // the end of the use, instead of more readings
    int ends_with = TACTUS_DEVICE_OK;        // of the last read
    std::function<void()> then = [] {};      // before `close`
};

/// Uses a device as Tactus does.
void play (const tactus_device_driver&, const std::string& port, const Use&);

/// Memory that a fake in a library maps as well.
template <typename T>
T& sharedMemory (const std::filesystem::path& file, const char* variable)
{
    const int opened = ::open (file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (opened < 0 || ::ftruncate (opened, sizeof (T)) != 0) std::abort();
    void* at = ::mmap (nullptr, sizeof (T), PROT_READ | PROT_WRITE, MAP_SHARED, opened, 0);
    ::close (opened);
    if (at == MAP_FAILED) std::abort();
    ::setenv (variable, file.c_str(), 1);
    return *static_cast<T*> (at);
}

/// The exercise of a driver, which a file in the driver's folder defines and so adds to the others.
struct Exercise
{
    explicit Exercise (void (*) (const TemporaryFolder&));
};

}   // namespace tactus::test
