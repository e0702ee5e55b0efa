// SPDX-License-Identifier: MIT
#pragma once

#include <host/code/fuse/fused_code.hpp>
#include <tactus/plan/steps/fused_tick.hpp>

#include <memory>
#include <string>
#include <vector>

namespace tactus::test
{

/// Waits for fused code. Returns the shared object, or fails the test with what the compiler says. Code that was compiled once in this
/// process is not compiled again.
std::string compiledFusion (const host::FusedCode&);

/// Waits for LLVM to compile the code of a plan, and loads it. Null if no LLVM is installed.
std::shared_ptr<const FusedTick> fusedByLlvm (const Plan&);

/// False if no LLVM is installed, or the program was built without clang.
bool hasLlvm();

/// The code of several plans as one source, because each run of the compiler spends most of its time on the headers.
class FusedPlans
{
public:
    void add (const Plan&);

    /// Compiles and loads them. In the order of add().
    std::vector<std::shared_ptr<const FusedTick>> load();

private:
    host::FusedCode all;
    std::string bodies;
    std::vector<std::vector<void*>> objects;
};

}   // namespace tactus::test
