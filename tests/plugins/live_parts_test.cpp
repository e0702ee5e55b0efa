// SPDX-License-Identifier: MIT
// Live C++: what decides whether a state may be adopted, and how messages of a compiler are read.
#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <host/code/plugins/compiler_output.hpp>
#include <host/code/plugins/declarations.hpp>
#include <host/code/plugins/live_source.hpp>
#include <tactus/file/text_file.hpp>

#include <string>

using namespace tactus;

namespace
{
/// True if the host concludes that two classes with these members have the same layout.
bool same (const std::string& a, const std::string& b)
{
    const auto whole = [] (const std::string& members) { return host::declarationsOf ("#include <x>\nnamespace n\n{\nstruct S\n{\n" + members + "\n};\n}\n"); };
    return whole (a) == whole (b);
}
}   // namespace

TEST_CASE ("an edit within the body of a function leaves the declarations of a header as they are", "[plugins][live]")
{
    CHECK (same ("double x; void f() { x = 1; }", "double x; void f() { if (x > 0) { x = 2; } }"));
    CHECK (same ("double x; double f() const noexcept { return x; }", "double x; double f() const noexcept { return \"}{\"[0]; }"));
    CHECK (same ("double x;", "double /* the { position */ x;   // }"));
    CHECK (same ("S() : x (1) { x = 2; } double x;", "S() : x (1) { x = 3; } double x;"));
    CHECK (same ("template <class T> void f (T t) { x = t; } double x;", "template <class T> void f (T t) { x = t; } double x;"));
}

TEST_CASE ("an edit that may move a member changes the declarations of a header", "[plugins][live]")
{
    CHECK_FALSE (same ("double x, y;", "double y, x;"));
    CHECK_FALSE (same ("double x;", "float x;"));
    CHECK_FALSE (same ("double x; void f() { }", "double x; void f() { } int more;"));
    CHECK_FALSE (same ("int n() { return 1; } struct { int a; } s;", "int n() { return 1; } struct { int a, b; } s;"));
    CHECK_FALSE (same ("struct alignas (16) { int a; } s;", "struct alignas (16) { int a, b; } s;"));
    // bodies that decide about members
    CHECK_FALSE (same ("static constexpr int n() { return 1; } int a[n()];", "static constexpr int n() { return 2; } int a[n()];"));
    CHECK_FALSE (same ("static constexpr int n() { if (true) { return 1; } return 2; } int a[n()];",
                       "static constexpr int n() { if (true) { return 3; } return 2; } int a[n()];"));
    CHECK_FALSE (same ("auto f() { return 1; } decltype (f()) x;", "auto f() { return 1.0; } decltype (f()) x;"));
    CHECK_FALSE (same ("int a[[] () { return 1; }()];", "int a[[] () { return 2; }()];"));
    CHECK_FALSE (same ("void f()\n{\n#define N 1\n} int a[N];", "void f()\n{\n#define N 2\n} int a[N];"));
    CHECK_FALSE (same ("\n#define N 1 \\\n + 1\nint a[N];", "\n#define N 1 \\\n + 2\nint a[N];"));
}

TEST_CASE ("the errors of a compiler become messages with file and line", "[plugins][live]")
{
    const auto errors = host::errorsOf ("In file included from plugin.cpp:2:\n"
                                        "my nodes/wood.hpp: In member function 'tick':\n"
                                        "my nodes/wood.hpp:42:17: error: 'forse' was not declared in this scope\n"
                                        "   42 |         forse = 1;\n"
                                        "my nodes/wood.hpp:7: fatal error: x.hpp: No such file or directory\n"
                                        "my nodes/wood.hpp:50:1: warning: unused\n",
                                        "wood.hpp");
    REQUIRE (errors.size() == 2);
    CHECK (errors[0].id == "live/compile");
    CHECK (errors[0].file == "my nodes/wood.hpp");
    CHECK (errors[0].line == 42);
    CHECK (errors[0].column == 17);
    CHECK (errors[0].text == "'forse' was not declared in this scope");
    CHECK (errors[0].where == "my nodes/wood.hpp:42:17");
    CHECK_FALSE (errors[0].remedy.empty());
    CHECK (errors[1].line == 7);

    const auto other = host::errorsOf ("c++: internal compiler problem\n" + std::string (5000, 'x'), "wood.hpp");
    REQUIRE (other.size() == 1);
    CHECK (other[0].where == "wood.hpp");
    CHECK (other[0].text.size() < 2000);
    CHECK (host::errorsOf ("", "wood.hpp").size() == 1);
}

TEST_CASE ("a header is made into a plugin by its TACTUS_NODE line", "[plugins][live]")
{
    TemporaryFolder folder;
    folder.write ("a.hpp", "struct A {};\nTACTUS_NODE (my::A);\n  TACTUS_NODE(my::B)\n// TACTUS_NODE (my::C);\n");
    const auto source = host::sourceFor (folder / "a.hpp");
    REQUIRE (source);
    CHECK (source->find ("TACTUS_PLUGIN (my::A, my::B)\n") != std::string::npos);
    CHECK (source->find ((folder / "a.hpp").string()) != std::string::npos);

    folder.write ("b.hpp", "struct A {};\n");
    CHECK (host::sourceFor (folder / "b.hpp").error().id == "live/no_node");
    CHECK (host::liveHeader (folder / "c.hpp").error().id == "live/no_header");
}

TEST_CASE ("what CMake writes next to a plugin says how to compile it", "[plugins][live]")
{
    TemporaryFolder folder;
    const auto plugin = folder / "p.tactus";
    CHECK (host::liveBuild (plugin).error().id == "live/no_build_file");
    folder.write ("p.cpp", "");
    folder.write ("p.hpp", "");
    folder.write ("p.txt", "");
    folder.write ("p.tactus.build", "compiler /usr/bin/c++\nsource " + (folder / "p.cpp").string() + "\ninclude /a b\ninclude /c\ndefine N=\"x y\"\n");
    const auto source = host::liveBuild (plugin);
    REQUIRE (source);
    CHECK (source->compiler == "/usr/bin/c++");
    CHECK (source->includes == std::vector<std::filesystem::path> { "/a b", "/c" });
    CHECK (source->definitions == std::vector<std::string> { "N=\"x y\"" });
    CHECK (source->watched() == std::vector<std::filesystem::path> { folder / "p.cpp", folder / "p.hpp" });

    folder.write ("p.tactus.build", "source " + (folder / "gone.cpp").string() + "\n");
    CHECK (host::liveBuild (plugin).error().id == "live/no_build_file");
}
