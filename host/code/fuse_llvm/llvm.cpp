// SPDX-License-Identifier: MIT
#include "llvm.hpp"

#include <dlfcn.h>

namespace tactus::host::llvm
{

namespace
{
#if defined(__x86_64__) || defined(__i386__)
constexpr const char* machine = "X86";
#elif defined(__aarch64__)
constexpr const char* machine = "AArch64";
#elif defined(__riscv)
constexpr const char* machine = "RISCV";
#else
constexpr const char* machine = "";
#endif

void* open (int version)
{
    const auto number = std::to_string (version);
    for (const auto& name : { "libLLVM-" + number + ".so.1", "libLLVM.so." + number + ".1", "libLLVM-" + number + ".so" })
        if (auto* library = ::dlopen (name.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
    return nullptr;
}

template <typename F>
bool find (void* library, const std::string& name, F& function)
{
    function = reinterpret_cast<F> (::dlsym (library, ("LLVM" + name).c_str()));
    return function != nullptr;
}

bool findAll (void* in, Library& l)
{
    return find (in, "ContextCreate", l.ContextCreate) && find (in, "CreateMemoryBufferWithContentsOfFile", l.CreateMemoryBufferWithContentsOfFile)
           && find (in, "CreateMemoryBufferWithMemoryRangeCopy", l.CreateMemoryBufferWithMemoryRangeCopy) && find (in, "ParseIRInContext", l.ParseIRInContext)
           && find (in, "LinkModules2", l.LinkModules2) && find (in, "VerifyModule", l.VerifyModule) && find (in, "GetFirstFunction", l.GetFirstFunction)
           && find (in, "GetNextFunction", l.GetNextFunction) && find (in, "GetFirstGlobal", l.GetFirstGlobal) && find (in, "GetNextGlobal", l.GetNextGlobal)
           && find (in, "IsDeclaration", l.IsDeclaration) && find (in, "GetValueName2", l.GetValueName2) && find (in, "SetLinkage", l.SetLinkage)
           && find (in, "SetVisibility", l.SetVisibility) && find (in, "GetTarget", l.GetTarget) && find (in, "SetTarget", l.SetTarget)
           && find (in, "GetDataLayoutStr", l.GetDataLayoutStr) && find (in, "SetDataLayout", l.SetDataLayout)
           && find (in, "GetTargetFromTriple", l.GetTargetFromTriple) && find (in, "CreateTargetMachine", l.CreateTargetMachine)
           && find (in, "CreatePassBuilderOptions", l.CreatePassBuilderOptions) && find (in, "RunPasses", l.RunPasses)
           && find (in, "GetErrorMessage", l.GetErrorMessage) && find (in, "TargetMachineEmitToFile", l.TargetMachineEmitToFile);
}

/// Makes LLVM know this machine.
bool initialise (void* library)
{
    for (const auto* part : { "TargetInfo", "Target", "TargetMC", "AsmPrinter" })
    {
        void (*begin)() = nullptr;
        if (! find (library, "Initialize" + std::string (machine) + part, begin)) return false;
        begin();
    }
    return true;
}
}   // namespace

int load (Library& functions)
{
    for (int version = oldest; version <= newest; ++version)
        if (auto* library = open (version); library != nullptr && findAll (library, functions) && initialise (library)) return version;
    return 0;
}

}   // namespace tactus::host::llvm
