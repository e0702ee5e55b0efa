// SPDX-License-Identifier: MIT
#include "exported_code.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/code/generate/sources/code.hpp>
#include <support/interpreter.hpp>
#include <support/random_graph.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>

namespace tactus::test
{

namespace
{
namespace fs = std::filesystem;

constexpr const char* flags_of_all = " -std=c++20 -Wall -Wextra -Wdouble-promotion -Werror -fno-exceptions -fno-rtti -ffp-contract=off -fno-math-errno "
                                     "-fno-trapping-math -I. -isystem /usr/include/eigen3";

class RandomHand final : public Device
{
public:
    explicit RandomHand (unsigned seed) : random (seed) {}

    void prepare (double) override {}

    Reading read() noexcept override
    {
        const auto step = [this] { return 1e-3 * (static_cast<double> (random()) / 2147483648.0 - 1.0); };
        for (int c = 0; c < 3; ++c)
            position[c] += step();
        Reading r;
        r.position = r.true_position = position;
        r.rotation = 10.0 * position;
        r.pressure = std::abs (100.0 * position.z());
        r.buttons = random() % 4;
        r.valid = random() % 60 != 0;
        if (random() % 50 == 0) r.position.x() = std::nan ("");
        return r;
    }

    void write (const Effort&) noexcept override {}

private:
    std::mt19937 random;
    Vec3 position = Vec3::Zero();
};

std::string contentOf (const fs::path& file)
{
    std::ifstream in (file, std::ios::binary);
    return { std::istreambuf_iterator<char> (in), {} };
}
}   // namespace

Run::OpenDevice randomHands (unsigned seed)
{
    return [seed] (const std::string& role, const graph::Graph&, const Plan&, Messages&) -> Run::RoleDevice {
        return { std::make_unique<RandomHand> (role == "left" ? seed : seed + 1), {} };
    };
}

host::ExportedFolder exportedRandomGraph (unsigned seed, int size, bool is_single)
{
    const auto graph = randomGraph (seed, size);
    host::ExportOptions options {
        .file = "random_" + std::to_string (seed) + ".json", .program = "tactus", .compile = {}, .is_single = is_single, .open = randomHands (seed)
    };
    for (const auto& [name, value] : Interpreter { graph, graph.rate_hz }.outputs())
        options.compile.records.push_back (name);
    return host::exportGraph (graph, options);
}

host::ExportedFolder exportedPreset (const std::string& name, bool is_single)
{
    const auto file = fs::path (TACTUS_SOURCE_DIR) / "graphs" / (name + ".json");
    const auto loaded = loadGraph (file);
    host::FileAssets assets;
    return host::exportGraph (loaded.graph,
                              { .file = file.filename().string(),
                                .program = "tactus",
                                .compile = { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } },
                                .is_single = is_single,
                                .open = {} });
}

std::string& textOf (host::ExportedFolder& exported, const std::string& path)
{
    return std::ranges::find (exported.files, path, &std::pair<std::string, std::string>::first)->second;
}

std::vector<std::string> presetNames()
{
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator (fs::path (TACTUS_SOURCE_DIR) / "graphs"))
        if (entry.path().extension() == ".json") all.push_back (entry.path().stem().string());
    std::ranges::sort (all);
    return all;
}

void ExportedProgram::add (const host::ExportedFolder& exported)
{
    for (const auto& [path, text] : exported.files)
    {
        fs::create_directories ((folder / path).parent_path());
        folder.write (path, text);
        if (path.starts_with ("tactus/") && path.ends_with (".cpp")) sources.insert (path);
    }
    stems.push_back (exported.stem);
    classes.push_back (exported.class_name);
}

/// One program of at most `count` graphs, from `first` on. In `per_graph`, @S@ is the stem and @C@ the class.
void ExportedProgram::writeMain (const std::string& head, const std::string& per_graph, std::size_t first, std::size_t count) const
{
    std::string program = "#define TACTUS_SELF_TEST_IS_INCLUDED\n", tests;
    for (std::size_t i = first; i < stems.size() && i - first < count; ++i)
    {
        program += "#include \"" + stems[i] + ".cpp\"\n#include \"" + stems[i] + "_self_test.cpp\"\n";
        tests += host::filled (per_graph, { { "@S@", stems[i] }, { "@C@", classes[i] } });
    }
    folder.write ("all.cpp", program + head + "int main()\n{\n    int failed = 0;\n" + tests + "    return failed;\n}\n");
}

bool ExportedProgram::succeeds (const std::string& command) const
{
    return std::system (("cd '" + folder.path().string() + "' && (" + command + ") >> said.txt 2>&1").c_str()) == 0;
}

/// Compiles the sources that graphs share. Each is compiled only once in all programs, because that takes as long as ten graphs.
bool ExportedProgram::compile (const std::string& compiler, std::string& objects) const
{
    static const TemporaryFolder kept;
    static std::map<std::string, std::string> known;   // the object by compiler and text
    for (const auto& source : sources)
    {
        auto& object = known[compiler + "\n" + contentOf (folder / source)];
        if (object.empty())
        {
            const auto name = (kept / (std::to_string (known.size()) + ".o")).string();
            if (! succeeds (compiler + " -c -o '" + name + "' " + source)) return false;
            object = name;
        }
        objects += " '" + object + "'";
    }
    return true;
}

std::string ExportedProgram::compileAndRun (const std::string& compiler, const std::string& link, const std::string& run) const
{
    const auto complete = compiler + flags_of_all;
    std::string objects;
    folder.write ("said.txt", "");
    const bool passed = compile (complete, objects) && succeeds (complete + " all.cpp" + objects + " " + link + " -o all") && succeeds (run);
    return (passed ? "passed\n" : "failed\n") + contentOf (folder / "said.txt");
}

std::string ExportedProgram::run (const std::string& compiler, const std::string& flags) const
{
    // Hides AVX and FMA from the C library, so that it takes its functions for older processors.
    constexpr const char* old = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4,-AVX512F,-AVX_Usable,-AVX2_Usable,-FMA_Usable,-FMA4_Usable,"
                                "-AVX512F_Usable ./all";
    constexpr const char* before_prepare = R"(
std::size_t allocations = 0;   // since the last graph

template <typename Effort>
bool isNothing (const Effort& e) { return e.force.isZero (0) && e.torque.isZero (0); }

/// True if a tick before prepare() gives no effort.
template <typename Graph>
bool isStillBeforePrepare()
{
    static Graph graph;
    static typename Graph::Inputs in;
    static typename Graph::Outputs out;
    if constexpr (requires { out.stylus.force; })
    {
        in.stylus.position.z() = -1;
        out.stylus.force.z() = 1;
        graph.tick (in, out);
        return isNothing (out.stylus);
    }
    return true;
}

)"
                                           R"(void* operator new (std::size_t size)
{
    ++allocations;
    return std::malloc (size > 0 ? size : 1);
}
void operator delete (void* memory) noexcept { std::free (memory); }
void operator delete (void* memory, std::size_t) noexcept { std::free (memory); }

)";
    writeMain (before_prepare, "    std::printf (\"@S@ takes %zu, %zu and %zu bytes\\n\", sizeof (@C@), sizeof (@C@::Inputs), sizeof (@C@::Outputs));\n"
                               "    if (! isStillBeforePrepare<@C@>()) std::printf (\"@S@ moves before prepare()\\n\");\n"
                               "    failed += @S@_self_test::test();\n"
                               "    if (allocations > 0) std::printf (\"@S@ takes memory from the heap\\n\");\n    allocations = 0;\n");
    return compileAndRun (compiler + " " + flags, {}, std::string ("./all && ") + old);
}

namespace
{
std::string compilerFor (ExportedProgram::Board board)
{
    const std::string unit = board == ExportedProgram::Board::m7 ? "-mcpu=cortex-m7 -mfpu=fpv5-d16" : "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16";
    return "arm-none-eabi-g++ " + unit + " -mthumb -mfloat-abi=hard -Wno-psabi -fno-threadsafe-statics -ffunction-sections -fdata-sections ";
}
}   // namespace

std::string ExportedProgram::runOn (Board board, const std::string& flags) const
{
    const std::string here = TACTUS_SOURCE_DIR "/tests/host/code/generate/boards/", machine = board == Board::m7 ? "an500" : "an386";
    constexpr std::size_t most = 10;   // more do not fit into the memory of the board
    bool passed = true;
    std::string all;
    for (std::size_t first = 0; first < stems.size(); first += most)
    {
        // With shift 6, QEMU's clock moves by 64 ns per instruction, and the timer by one in 40 ns.
        writeMain ("extern \"C\" unsigned long timer();\n",
                   "    {\n        static @C@ graph;\n        graph.prepare();\n        const auto begin = timer();\n        @S@_self_test::repeat (graph);\n"
                   "        std::printf (\"@S@: %lu bytes, %lu instructions per tick\\n\", static_cast<unsigned long> (sizeof graph),\n"
                   "                     static_cast<unsigned long> (static_cast<double> (begin - timer()) * 40.0 / 64.0 / 1200.0));\n"
                   "        failed += @S@_self_test::test();\n    }\n",
                   first, most);
        const auto said = compileAndRun (compilerFor (board) + flags,
                                         "-nostartfiles -Wl,--gc-sections -L '" + here + "' -T " + machine + ".ld '" + here + "start.cpp'",
                                         "qemu-system-arm -M mps2-" + machine
                                             + " -nographic -monitor none -serial none -chardev stdio,id=said "
                                               "-semihosting-config enable=on,target=native,chardev=said -icount shift=6 -kernel all");
        passed = passed && said.starts_with ("passed");
        all += said.substr (said.find ('\n') + 1);
    }
    return (passed ? "passed\n" : "failed\n") + all;
}

std::string ExportedProgram::runInNode (const std::string& flags) const
{
    // A time of 20 repetitions: the shortest of 20, because node compiles twice, the second time better.
    writeMain (R"(#include <chrono>
#ifdef __wasm__
constexpr const char* where = "in node";
#else
constexpr const char* where = "natively";
#endif
)",
               R"(    {
        static @C@ graph;
        graph.prepare();
        double shortest = 1e300;
        for (int i = 0; i < 20; ++i)
        {
            const auto begin = std::chrono::steady_clock::now();
            for (int n = 0; n < 20; ++n)
                @S@_self_test::repeat (graph);
            const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
            if (took.count() < shortest) shortest = took.count();
        }
        std::printf ("@S@ %s: %.1f ns\n", where, shortest / (20 * 1200));
        failed += @S@_self_test::test();
    }
)");
    if (const auto native = compileAndRun ("g++ " + flags, {}, "mv all native"); ! native.starts_with ("passed")) return native;
    const std::string both = "./native && node --no-warnings '" TACTUS_SOURCE_DIR "/tests/host/code/generate/wasm/run_wasi.cjs' all";
    return compileAndRun ("clang++-22 --target=wasm32-wasi -Wno-deprecated -fno-threadsafe-statics " + flags, "-Wl,--stack-first,-z,stack-size=262144",
                          both + " && " + both);
}

std::string ExportedProgram::instructions (const std::string& pattern) const
{
    folder.write ("said.txt", "");
    succeeds ("objdump -d all | grep -E -m 10 '" + pattern + "'");
    return contentOf (folder / "said.txt");
}

std::string ExportedProgram::callsOn (Board board, const std::string& pattern) const
{
    std::string text, objects;
    for (const auto& stem : stems)
        text += "#include \"" + stem + ".cpp\"\n";
    folder.write ("graphs.cpp", text);
    folder.write ("said.txt", "");
    const auto compiler = compilerFor (board) + "-O2" + flags_of_all;
    if (! compile (compiler, objects) || ! succeeds (compiler + " -c graphs.cpp -o graphs.o")) return "failed\n" + contentOf (folder / "said.txt");
    succeeds ("arm-none-eabi-nm -u -C graphs.o" + objects + " | grep -E '" + pattern + "' | sort | uniq -c");
    return contentOf (folder / "said.txt");
}

}   // namespace tactus::test
