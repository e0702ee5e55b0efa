// SPDX-License-Identifier: MIT
/// tactus-fuse-llvm FUNCTION OUTPUT.so WIRING.ll BITCODE...
///
/// Makes a shared object from the code of a graph (host/code/fuse): optimises its wiring together with the bitcode of its nodes, by LLVM, and
/// links the result. A separate program, because LLVM is large and may crash or hang.

#include "llvm.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace
{
using namespace tactus::host;

/// Exit statuses other than 1, which is a failure of LLVM or the linker.
constexpr int no_library = 3, no_linker = 4;

[[noreturn]] void fail (const std::string& why, int status = 1)
{
    std::fprintf (stderr, "%s\n", why.c_str());
    std::exit (status);
}

class Compilation
{
public:
    Compilation() : version (llvm::load (use))
    {
        if (version == 0) fail ("no LLVM from version " + std::to_string (llvm::oldest) + " on is installed", no_library);
        context = use.ContextCreate();
    }

    /// Adds bitcode. The first file sets the machine that the code is for.
    void add (const std::string& file)
    {
        llvm::Buffer buffer = nullptr;
        if (use.CreateMemoryBufferWithContentsOfFile (file.c_str(), &buffer, &message) != 0) fail (message);
        add (buffer);
    }

    /// Adds LLVM's assembly language. It has the pointers of LLVM 14, with types; from version 17 on, LLVM knows only pointers without.
    void addText (const std::string& file)
    {
        std::ifstream in (file);
        std::string text { std::istreambuf_iterator<char> (in), {} };
        if (version >= first_without_types) text = std::regex_replace (text, std::regex ("(i8|i64|double)\\*+"), "ptr");
        add (use.CreateMemoryBufferWithMemoryRangeCopy (text.data(), text.size(), "wiring"));
    }

    /// Hides everything but this function, so that the optimiser may inline and remove the rest.
    void hideAllBut (const std::string& function)
    {
        bool is_there = false;
        const auto hide = [&] (llvm::Value v) {
            std::size_t size = 0;
            const auto* name = use.GetValueName2 (v, &size);
            const std::string_view all (name, size);
            if (use.IsDeclaration (v) != 0 || all.starts_with ("llvm.")) return;
            if (all == function)
                is_there = true;
            else
            {
                use.SetVisibility (v, default_visibility);   // the only one that internal code may have
                use.SetLinkage (v, internal_linkage);
            }
        };
        for (auto v = use.GetFirstFunction (module); v != nullptr; v = use.GetNextFunction (v))
            hide (v);
        for (auto v = use.GetFirstGlobal (module); v != nullptr; v = use.GetNextGlobal (v))
            hide (v);
        if (! is_there) fail ("there is no function " + function);
    }

    void emit (std::string object)
    {
        constexpr int return_status = 2, object_file = 1, aggressive = 3, position_independent = 2, default_model = 0;
        if (use.VerifyModule (module, return_status, &message) != 0) fail (message);
        const auto* triple = use.GetTarget (module);
        llvm::Target target = nullptr;
        if (use.GetTargetFromTriple (triple, &target, &message) != 0) fail (message);
        auto* machine = use.CreateTargetMachine (target, triple, "", "", aggressive, position_independent, default_model);
        if (auto* error = use.RunPasses (module, "default<O3>", machine, use.CreatePassBuilderOptions())) fail (use.GetErrorMessage (error));
        if (use.TargetMachineEmitToFile (machine, module, object.data(), object_file, &message) != 0) fail (message);
    }

private:
    static constexpr int first_without_types = 17, internal_linkage = 8, default_visibility = 0;

    void add (llvm::Buffer buffer)
    {
        llvm::Module next = nullptr;
        if (use.ParseIRInContext (context, buffer, &next, &message) != 0) fail (message);
        if (module == nullptr)
        {
            module = next;
            return;
        }
        use.SetTarget (next, use.GetTarget (module));   // which the wiring does not have
        use.SetDataLayout (next, use.GetDataLayoutStr (module));
        if (use.LinkModules2 (module, next) != 0) fail ("the modules do not fit together");
    }

    llvm::Library use {};
    int version;
    llvm::Context context = nullptr;
    llvm::Module module = nullptr;
    char* message = nullptr;
};

/// Becomes the linker. Returns if there is none.
void link (std::string object, std::string output)
{
    std::vector<std::string> linkers { "ld", "ld.lld" };
    for (int version = llvm::oldest; version <= llvm::newest; ++version)
        linkers.push_back ("ld.lld-" + std::to_string (version));
    for (auto& linker : linkers)
    {
        std::string words[] { linker, "-shared", "-z", "now", "-z", "relro", "-z", "noexecstack", "-o", output, object };
        std::vector<char*> command;
        for (auto& word : words)
            command.push_back (word.data());
        command.push_back (nullptr);
        ::execvp (command[0], command.data());
    }
}
}   // namespace

int main (int count, char** words)
{
    if (count < 5) fail ("usage: tactus-fuse-llvm FUNCTION OUTPUT.so WIRING.ll BITCODE...", 2);
    const std::string output = words[2], object = output + ".o";
    {
        Compilation all;
        for (int i = 4; i < count; ++i)
            all.add (words[i]);
        all.addText (words[3]);
        all.hideAllBut (words[1]);
        all.emit (object);
    }
    link (object, output);
    fail ("no linker is installed: neither ld nor ld.lld", no_linker);
}
