// SPDX-License-Identifier: GPL-3.0-or-later
#include "exported_code.hpp"

#include <host/assets/file_assets.hpp>
#include <host/assets/nearest_by_embree.hpp>
#include <host/generate/code.hpp>
#include <support/interpreter.hpp>
#include <support/random_graph.hpp>
#include <tactus/file/graph_file.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>

namespace tactus::test
{

namespace
{
namespace fs = std::filesystem;

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

host::ExportedFolder exportedRandomGraph (unsigned seed, int size)
{
    const auto graph = randomGraph (seed, size);
    host::ExportOptions options { .file = "random_" + std::to_string (seed) + ".json", .program = "tactus", .compile = {}, .open = randomHands (seed) };
    for (const auto& [name, value] : Interpreter { graph, graph.rate_hz }.outputs())
        options.compile.records.push_back (name);
    return host::exportGraph (graph, options);
}

host::ExportedFolder exportedPreset (const std::string& name, host::ExportTarget target)
{
    const auto file = fs::path (TACTUS_SOURCE_DIR) / "graphs" / (name + ".json");
    const auto loaded = loadGraph (file);
    host::FileAssets assets;
    return host::exportGraph (loaded.graph,
                              { .file = file.filename().string(),
                                .program = "tactus",
                                .compile = { .assets = &assets, .services = { .nearest_triangle = host::nearestByEmbree } },
                                .target = target,
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

/// One program of all graphs. In `per_graph`, @S@ is the stem and @C@ the class.
void ExportedProgram::writeMain (const std::string& head, const std::string& per_graph) const
{
    std::string program = "#define TACTUS_SELF_TEST_IS_INCLUDED\n", tests;
    for (std::size_t i = 0; i < stems.size(); ++i)
    {
        program += "#include \"" + stems[i] + ".cpp\"\n#include \"" + stems[i] + "_self_test.cpp\"\n";
        tests += host::filled (per_graph, { { "@S@", stems[i] }, { "@C@", classes[i] } });
    }
    folder.write ("all.cpp", program + head + "int main()\n{\n    int failed = 0;\n" + tests + "    return failed;\n}\n");
}

std::string ExportedProgram::compileAndRun (const std::string& compile, const std::string& run) const
{
    std::string files = " -std=c++20 -Wall -Wextra -Werror -fno-exceptions -fno-rtti -ffp-contract=off -fno-math-errno -fno-trapping-math -I. -isystem "
                        "/usr/include/eigen3 all.cpp";
    for (const auto& source : sources)
        files += " " + source;
    const auto there = "cd '" + folder.path().string() + "' && ";
    const auto succeeds = [&] (const std::string& command) { return std::system ((there + command).c_str()) == 0; };
    const bool passed = succeeds (compile + files + " > said.txt 2>&1") && succeeds (run + " >> said.txt 2>&1");
    return (passed ? "passed\n" : "failed\n") + contentOf (folder / "said.txt");
}

std::string ExportedProgram::run (const std::string& compiler, const std::string& flags) const
{
    writeMain ({}, "    failed += @S@_self_test::test();\n");
    return compileAndRun (compiler + " " + flags + " -o all", "./all");
}

std::string ExportedProgram::runOnM7 (const std::string& flags) const
{
    // With shift 6, QEMU's clock moves by 64 ns per instruction, and the timer by one in 40 ns.
    writeMain ("extern \"C\" unsigned long timer();\n",
               "    {\n        static @C@ graph;\n        graph.prepare();\n        const auto begin = timer();\n        @S@_self_test::repeat (graph);\n"
               "        std::printf (\"@S@: %lu bytes, %lu instructions per tick\\n\", static_cast<unsigned long> (sizeof graph),\n"
               "                     static_cast<unsigned long> (static_cast<double> (begin - timer()) * 40.0 / 64.0 / 1200.0));\n"
               "        failed += @S@_self_test::test();\n    }\n");
    const std::string here = TACTUS_SOURCE_DIR "/tests/host/generate/boards/";
    return compileAndRun ("arm-none-eabi-g++ -mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard -fno-threadsafe-statics -ffunction-sections "
                          "-fdata-sections "
                              + flags + " -nostartfiles -Wl,--gc-sections -T '" + here + "an500.ld' '" + here + "start.cpp' -o all.elf",
                          "qemu-system-arm -M mps2-an500 -nographic -monitor none -serial none -chardev stdio,id=said "
                          "-semihosting-config enable=on,target=native,chardev=said -icount shift=6 "
                          "-kernel all.elf");
}

}   // namespace tactus::test
