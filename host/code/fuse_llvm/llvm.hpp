// SPDX-License-Identifier: MIT
#pragma once

/// The part of LLVM's C interface that is used here. LLVM is loaded when the program starts and not linked, so any version from 14 on that
/// is installed will do, and Tactus builds without it.

#include <cstddef>
#include <string>

namespace tactus::host::llvm
{

// LLVM's own types, which are only passed on.
using Context = struct OpaqueContext*;
using Module = struct OpaqueModule*;
using Buffer = struct OpaqueBuffer*;
using Value = struct OpaqueValue*;
using Target = struct OpaqueTarget*;
using Machine = struct OpaqueMachine*;
using PassOptions = struct OpaquePassOptions*;
using Error = struct OpaqueError*;

/// The functions, by the names that LLVM gives them, without "LLVM". A result of type int is 0 if all went well.
struct Library
{
    Context (*ContextCreate)();
    int (*CreateMemoryBufferWithContentsOfFile) (const char* path, Buffer*, char** message);
    Buffer (*CreateMemoryBufferWithMemoryRangeCopy) (const char* text, std::size_t size, const char* name);
    int (*ParseIRInContext) (Context, Buffer, Module*, char** message);
    int (*LinkModules2) (Module into, Module from);
    int (*VerifyModule) (Module, int action, char** message);
    Value (*GetFirstFunction) (Module);
    Value (*GetNextFunction) (Value);
    Value (*GetFirstGlobal) (Module);
    Value (*GetNextGlobal) (Value);
    int (*IsDeclaration) (Value);
    const char* (*GetValueName2) (Value, std::size_t* size);
    void (*SetLinkage) (Value, int linkage);
    void (*SetVisibility) (Value, int visibility);
    const char* (*GetTarget) (Module);
    void (*SetTarget) (Module, const char* triple);
    const char* (*GetDataLayoutStr) (Module);
    void (*SetDataLayout) (Module, const char* layout);
    int (*GetTargetFromTriple) (const char* triple, Target*, char** message);
    Machine (*CreateTargetMachine) (Target, const char* triple, const char* cpu, const char* features, int level, int relocations, int code_model);
    PassOptions (*CreatePassBuilderOptions)();
    Error (*RunPasses) (Module, const char* passes, Machine, PassOptions);
    char* (*GetErrorMessage) (Error);
    int (*TargetMachineEmitToFile) (Machine, Module, char* path, int kind, char** message);
};

/// The oldest version that has the functions above and reads the code that is shipped, and the newest one that is looked for.
inline constexpr int oldest = 14, newest = 22;

/// Loads the oldest version that is installed, and makes it ready for this machine. Returns its number; 0 if there is none.
int load (Library&);

}   // namespace tactus::host::llvm
