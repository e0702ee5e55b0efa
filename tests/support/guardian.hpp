// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <sys/types.h>

namespace tactus::test
{

/// The guardian process (host/devices/failsafe/guardian.hpp) that this process has forked; -1 if there is none. A moment after the fork it
/// does not have its name yet.
inline pid_t guardianOf (pid_t process)
{
    for (const auto& entry : std::filesystem::directory_iterator ("/proc"))
    {
        std::ifstream stat (entry.path() / "stat");
        pid_t id = -1, parent = -1;
        std::string name;
        char state = 0;
        if (stat >> id >> name >> state >> parent && name == "(force-guardian)" && parent == process && state != 'Z') return id;
    }
    return -1;
}

}   // namespace tactus::test
