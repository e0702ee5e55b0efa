// SPDX-License-Identifier: GPL-3.0-or-later
#include "exported_code.hpp"

#include <host/assets/file_assets.hpp>
#include <host/assets/nearest_by_embree.hpp>
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

host::ExportedFolder exportedPreset (const std::string& name)
{
    const auto file = fs::path (TACTUS_SOURCE_DIR) / "graphs" / (name + ".json");
    const auto loaded = loadGraph (file);
    host::FileAssets assets;
    return host::exportGraph (loaded.graph,
                              { .file = file.filename().string(),
                                .program = "tactus",
                                .compile = { .assets = &assets, .services = { .nearest_triangle = host::nearestByEmbree } },
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
}

std::string ExportedProgram::run (const std::string& compiler, const std::string& flags) const
{
    std::string program = "#define TACTUS_SELF_TEST_IS_INCLUDED\n", tests;
    for (const auto& stem : stems)
    {
        program += "#include \"" + stem + ".cpp\"\n#include \"" + stem + "_self_test.cpp\"\n";
        tests += "    failed += " + stem + "_self_test::test();\n";
    }
    folder.write ("all.cpp", program + "int main()\n{\n    int failed = 0;\n" + tests + "    return failed;\n}\n");
    std::string files = "all.cpp";
    for (const auto& source : sources)
        files += " " + source;
    const auto there = "cd '" + folder.path().string() + "' && ";
    const auto compile = compiler + " -std=c++20 " + flags
                         + " -Wall -Wextra -Werror -fno-exceptions -fno-rtti -ffp-contract=off -fno-math-errno -fno-trapping-math -I. -isystem "
                           "/usr/include/eigen3 -o all "
                         + files;
    const bool passed = std::system ((there + compile + " > said.txt 2>&1").c_str()) == 0 && std::system ((there + "./all >> said.txt 2>&1").c_str()) == 0;
    return (passed ? "passed\n" : "failed\n") + contentOf (folder / "said.txt");
}

}   // namespace tactus::test
