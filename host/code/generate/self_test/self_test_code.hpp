// SPDX-License-Identifier: MIT
#pragma once

#include <host/code/generate/class/exported.hpp>

#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// A change that a self-test makes to the graph before a tick.
struct SelfTestEvent
{
    enum class Kind
    {
        param,
        control,
        hit
    };

    std::size_t tick = 0;
    Kind kind = Kind::param;
    std::size_t number = 0;   ///< in Exported::parameters, controls or hits
    double value = 0.0;
};

/// One number per tick.
struct SelfTestColumn
{
    std::string target;   ///< "in.stylus.position.x() = @", "out.stylus.force.x()"
    std::vector<double> values;
};

/// Inputs of a run, and the outputs that the engine of this program gave.
struct SelfTest
{
    std::size_t ticks = 0;
    std::vector<SelfTestEvent> events;
    std::vector<SelfTestColumn> inputs, outputs;
};

struct SelfTestFiles
{
    std::string source, data;
};

/// Writes a program that runs the graph on these inputs and compares all bits.
SelfTestFiles selfTestFiles (const Exported&, const SelfTest&);

}   // namespace tactus::host
