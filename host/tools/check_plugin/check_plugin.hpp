// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::check_plugin
{

struct Options
{
    std::filesystem::path file {};
    int level = 5;           ///< 1 to 10: which examinations, and how many trials each
    unsigned seed = 1;       ///< of the first trial; each further trial adds 1
    std::string device {};   ///< of a driver: the keys of a description as a JSON object, to open a device; "": none
    int cpu_seconds = 5;     ///< of CPU time, for loading, and for each call of a hook; each examination gets 24 times as much
};

enum class Verdict
{
    pass,
    fail,
    skipped
};

/// The result of one examination.
struct Finding
{
    std::string id, promise;
    Verdict verdict = Verdict::pass;
    std::string why {};   ///< why it failed or was skipped
};

struct CheckedNode
{
    std::string id;
    double tick_ns = 0.0;   ///< 0: not measured
    std::vector<Finding> findings {};
};

struct Report
{
    Options options;
    bool is_driver = false;   ///< a device driver (tactus_device.h), not a node plugin
    std::string name {}, version {};
    std::vector<Finding> findings {};   ///< about the plugin as a whole
    std::vector<CheckedNode> nodes {};
    std::vector<std::string> notes {};

    int failures() const;
};

/// Loads and examines a plugin in other processes, so this function returns, whatever the plugin does. [main thread, no other threads]
Report checkPlugin (const Options&);

/// The report for people, and for programs.
std::string textOf (const Report&);
Json jsonOf (const Report&);

}   // namespace tactus::check_plugin
