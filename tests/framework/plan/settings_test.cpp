// SPDX-License-Identifier: MIT
#include "support/sketch.hpp"

#include <support/property.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/settings.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

namespace
{
struct Mode
{
    double frequency = 100.0;
    int count = 2;
    std::string name = "fresh";

    static constexpr std::tuple fields {
        field (&Mode::frequency, "frequency", unit::hertz, "of the mode", { .hard = { 0, inf } }),
        field (&Mode::count, "count", unit::count, "how many", { .hard = { 1, 8 } }),
        field (&Mode::name, "name", unit::count, "what it is called"),
    };
};

struct Model
{
    std::vector<double> coefficients { 0.5 };
    Vec3 direction = Vec3::UnitZ();
    Mode mode {};

    static constexpr std::tuple fields {
        field (&Model::coefficients, "coefficients", unit::gain, "of the filter", { .hard = { -2, 2 } }),
        field (&Model::direction, "direction", unit::gain, "where to"),
        field (&Model::mode, "mode", unit::count, "a record within"),
    };
};

/// A node with a setting of every kind.
struct Wanting
{
    struct Inputs
    {
    };
    struct Params
    {
    };
    struct Settings
    {
        double length = 0.1;
        int number = 3;
        std::string text = "in[0]";
        Vec3 vector = Vec3::UnitX();
        std::vector<double> numbers { 1.0 };
        Curve curve {};
        Law law {};
        Mode record {};
        std::vector<Model> records {};
        std::shared_ptr<const Signal> signal;
        Image image;
        Sheet table;
        std::shared_ptr<const Surface> surface;
    };
    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info { .id = "test.wanting", .name = "Wanting", .summary = "Takes every kind of setting.", .source = "none" };

    static constexpr std::tuple ports {
        setting (&Settings::length, "length", unit::metre, "a length", { .hard = { 0, 1 } }),
        setting (&Settings::number, "number", unit::count, "a whole number", { .hard = { 1, 10 } }),
        setting (&Settings::text, "text", unit::count, "a string"),
        setting (&Settings::vector, "vector", unit::metre, "a vector"),
        setting (&Settings::numbers, "numbers", unit::newton, "a list of numbers", { .hard = { 0, 5 } }),
        setting (&Settings::curve, "curve", unit::metre, unit::newton, "a curve"),
        setting (&Settings::law, "law", unit::metre, unit::newton, "a law"),
        setting (&Settings::record, "record", unit::count, "a record"),
        setting (&Settings::records, "records", unit::count, "a list of records"),
        setting (&Settings::signal, "signal", unit::count, "a recording"),
        setting (&Settings::image, "image", unit::count, "a picture"),
        setting (&Settings::table, "table", unit::count, "a table"),
        setting (&Settings::surface, "surface", unit::count, "a surface"),
        output (&Outputs::out, "out", unit::count, "nothing"),
    };

    Params params;
    Settings settings;

    Outputs tick (const Inputs&) noexcept { return {}; }
};

/// A fake disk with one file of each kind. It records all requests.
struct Disk final : Assets
{
    std::vector<std::string> asked;
    std::shared_ptr<const Signal> one_signal = std::make_shared<const Signal> (Signal { 8000.0, { { 1.0, 2.0 } } });
    std::shared_ptr<const Grid> one_image = std::make_shared<const Grid> (Grid { 1, 1, { 0.5 } });
    std::shared_ptr<const Grid> one_table = std::make_shared<const Grid> (Grid { 1, 2, { 3.0, 4.0 } });
    std::shared_ptr<const Mesh> one_mesh = std::make_shared<const Mesh> (Mesh { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } } });

    template <typename T>
    Loaded<T> give (const std::string& path, const std::shared_ptr<const T>& content)
    {
        asked.push_back (path);
        if (path.find ("gone") != std::string::npos) return Message::error ("asset/unreadable", path, "there is no such file");
        return content;
    }
    Loaded<Signal> signal (const std::string& path) override { return give (path, one_signal); }
    Loaded<Grid> image (const std::string& path) override { return give (path, one_image); }
    Loaded<Grid> table (const std::string& path) override { return give (path, one_table); }
    Loaded<Mesh> mesh (const std::string& path) override { return give (path, one_mesh); }
};

const NodeType& type()
{
    static const NodeType one = describe<Wanting>();
    return one;
}

Messages messagesFor (const char* id, const Json& value, Assets* assets, const std::string& folder = "")
{
    test::Sketch sketch;
    sketch.graph.folder = folder;
    sketch.node ("it", "test.wanting", Json::object(), { { id, value } });
    return compile (sketch.graph, Catalogue { { describe<Wanting>() } }, { .assets = assets }).messages;
}

/// The settings of a node whose setting `id` has this value in the graph.
Wanting::Settings reads (const char* id, const Json& value)
{
    Disk disk;
    const auto messages = messagesFor (id, value, &disk);
    INFO (test::text (messages));
    REQUIRE (messages.empty());

    const auto sheet = std::ranges::find (type().settings, std::string_view (id), &SettingSheet::id);
    std::string where;
    Disk again;
    const auto read = plan::readSetting (value, *sheet, { &again, "" }, where);
    REQUIRE (read.has_value());
    const auto node = type().make();
    sheet->set (node.get(), *read);
    return static_cast<Wanting*> (node.get())->settings;
}

/// "pointer: text" of the only error, with the pointer relative to the setting.
std::string refusal (const char* id, const Json& value, bool with_files = true)
{
    Disk disk;
    const auto messages = messagesFor (id, value, with_files ? &disk : nullptr);
    REQUIRE (messages.size() == 1);
    CHECK (messages[0].id == "setting/value");
    const auto base = std::string ("/nodes/it/settings/") + id, lead = std::string ("setting '") + id + "' of 'it': ";
    CHECK (messages[0].where.starts_with (base));
    CHECK (messages[0].text.starts_with (lead));
    return messages[0].where.substr (std::min (base.size(), messages[0].where.size())) + ": "
           + messages[0].text.substr (std::min (lead.size(), messages[0].text.size()));
}

bool contains (const std::string& text, const std::string& part) { return text.find (part) != std::string::npos; }
}   // namespace

TEST_CASE ("a number is SI or has a unit, and must be in range", "[plan][settings]")
{
    CHECK (reads ("length", 0.2).length == 0.2);
    CHECK (reads ("length", "20 mm").length == Approx (0.02));
    CHECK (refusal ("length", "20 mN") == ": its unit is N, but it must be m");
    CHECK (refusal ("length", 2) == ": 2 is out of range: it must be from 0 to 1");
    CHECK (contains (refusal ("length", Json::array ({ 1 })), "neither a number nor text"));
    CHECK (contains (refusal ("length", nullptr), "neither a number nor text"));

    CHECK (reads ("number", 4).number == 4);
    CHECK (refusal ("number", 4.5) == ": 4.5 is not a whole number");
    CHECK (refusal ("number", 11) == ": 11 is out of range: it must be from 1 to 10");
    CHECK (contains (refusal ("number", 1e300), "is out of range"));
}

TEST_CASE ("a text must be a string", "[plan][settings]")
{
    CHECK (reads ("text", "a b").text == "a b");
    CHECK (refusal ("text", 4) == ": it must be a string");
}

TEST_CASE ("a vector has three numbers, each with an optional unit", "[plan][settings]")
{
    CHECK (reads ("vector", { 1, 2, "30 mm" }).vector.isApprox (Vec3 (1, 2, 0.03)));
    CHECK (refusal ("vector", { 1, 2 }) == ": it must be three numbers, such as [0, 0, 1], but it is a list of 2");
    CHECK (refusal ("vector", 3) == ": it must be three numbers, such as [0, 0, 1], but it is 3");
    CHECK (refusal ("vector", { 1, 2, "1 N" }) == "/2: its unit is N, but it must be m");
}

TEST_CASE ("`numbers` is a list, which may be empty", "[plan][settings]")
{
    CHECK (reads ("numbers", { 1, "2 mN" }).numbers == std::vector { 1.0, 0.002 });
    CHECK (reads ("numbers", Json::array()).numbers.empty());
    CHECK (refusal ("numbers", 1) == ": it must be a list of numbers, but it is 1");
    CHECK (refusal ("numbers", { 1, 6 }) == "/1: 6 is out of range: it must be from 0 to 5");
    CHECK (contains (refusal ("numbers", { 1, "x" }), "/1: "));
}

TEST_CASE ("a curve has two lists, and its x must increase", "[plan][settings]")
{
    const auto curve = reads ("curve", { { 0, "10 mm" }, { 1, 2 } }).curve;
    CHECK (curve.x == std::vector { 0.0, 0.01 });
    CHECK (curve.y == std::vector { 1.0, 2.0 });
    CHECK (refusal ("curve", { 1, 2 }) == ": it must be [[x…], [y…]]");
    CHECK (contains (refusal ("curve", { { 0, 1 }, { 1 } }), ": both lists need the same length"));
    CHECK (contains (refusal ("curve", { Json::array(), Json::array() }), ": both lists need the same length, at least 1"));
    CHECK (refusal ("curve", { { 0, 0 }, { 1, 1 } }) == "/0/1: x must increase, but 0 follows 0");
    CHECK (refusal ("curve", { { 0, 1 }, { 1, "1 m" } }) == "/1/1: its unit is m, but it must be N");
}

TEST_CASE ("a law must have a known form", "[plan][settings]")
{
    CHECK (reads ("law", { { "power", { 100, 1 } } }).law (0.01) == Approx (1.0));
    CHECK (contains (refusal ("law", 3), ": it must be {\"power\""));
    CHECK (contains (refusal ("law", { { "pawer", { 100, 1 } } }), "/pawer: it must be {\"power\""));
    CHECK (refusal ("law", { { "power", { 100 } } }) == "/power: it must be a list of two numbers");
    CHECK (contains (refusal ("law", { { "power", { -1, 1 } } }), "/power/0: -1 is out of range"));
    CHECK (contains (refusal ("law", { { "table", { { -1, 1 }, { 0, 1 } } } }), "/table/0/0: "));
    CHECK (contains (refusal ("law", { { "table", { { 0, 1 }, { 1, 1 } } } }), "/table/1/0: a law must start at (0, 0)"));
}

TEST_CASE ("a record keeps the defaults of missing fields", "[plan][settings]")
{
    const auto mode = reads ("record", { { "frequency", "2 kHz" } }).record;
    CHECK (mode.frequency == 2000.0);
    CHECK (mode.count == 2);
    CHECK (mode.name == "fresh");
    CHECK (reads ("record", Json::object()).record.frequency == 100.0);

    CHECK (contains (refusal ("record", 3), ": it must be an object with"));
    CHECK (refusal ("record", { { "frequncy", 3 } }) == "/frequncy: it has no 'frequncy' (did you mean 'frequency'?); it takes frequency, count, name");
    CHECK (contains (refusal ("record", { { "frequency", -3 } }), "/frequency: -3 is out of range"));
    CHECK (refusal ("record", { { "count", 1.5 } }) == "/count: 1.5 is not a whole number");
    CHECK (refusal ("record", { { "name", 1 } }) == "/name: it must be a string");
}

TEST_CASE ("records can hold lists, vectors and other records", "[plan][settings]")
{
    const auto models = reads ("records", { { { "coefficients", { 1, -0.9 } }, { "mode", { { "count", 5 } } } }, { { "direction", { 1, 0, 0 } } } }).records;
    REQUIRE (models.size() == 2);
    CHECK (models[0].coefficients == std::vector { 1.0, -0.9 });
    CHECK (models[0].direction == Vec3::UnitZ());
    CHECK (models[0].mode.count == 5);
    CHECK (models[0].mode.frequency == 100.0);
    CHECK (models[1].coefficients == std::vector { 0.5 });
    CHECK (models[1].direction == Vec3::UnitX());
    CHECK (reads ("records", Json::array()).records.empty());

    const Json fine = Json::object();
    CHECK (refusal ("records", 3) == ": it must be a list of records, but it is 3");
    CHECK (contains (refusal ("records", { fine, 3 }), "/1: record 1 must be an object with"));
    CHECK (contains (refusal ("records", { fine, { { "coefficients", { 0, 3 } } } }), "/1/coefficients/1: 3 is out of range"));
    CHECK (contains (refusal ("records", { { { "mode", { { "count", 9 } } } } }), "/0/mode/count: 9 is out of range"));
    CHECK (contains (refusal ("records", { { { "mode", { { "cuont", 9 } } } } }), "/0/mode/cuont: it has no 'cuont' (did you mean 'count'?)"));
    CHECK (contains (refusal ("records", { { { "direction", { 1, 2 } } } }), "/0/direction: it must be three numbers"));
}

TEST_CASE ("files are found relative to the folder of the graph, and read as the setting needs", "[plan][settings]")
{
    CHECK (reads ("signal", "tap.wav").signal->rate_hz == 8000.0);
    CHECK (reads ("image", "bark.png").image.grid->values[0] == 0.5);
    CHECK (reads ("table", "scan.csv").table.grid->values[1] == 4.0);

    for (const auto* id : { "signal", "image", "table" })
    {
        Disk disk;
        CHECK (messagesFor (id, "data/a.x", &disk, "some/where").empty());
        CHECK (messagesFor (id, "/data/a.x", &disk, "some/where").empty());
        CHECK (disk.asked == std::vector<std::string> { "some/where/data/a.x", "/data/a.x" });

        CHECK (refusal (id, "gone.x") == ": gone.x: there is no such file");
        CHECK (refusal (id, 3) == ": it must be the path of a file, relative to the folder of the graph");
        CHECK (refusal (id, "") == ": it must be the path of a file, relative to the folder of the graph");
        CHECK (contains (refusal (id, "a.x", false), "cannot read 'a.x'"));
    }
}

namespace
{
const Json linear = { { "power", { 1000, 1 } } };
const Json axes = { linear, linear, linear };

/// A square of two triangles.
Json square()
{
    return { { "nodes", { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, "10 mm" } } },
             { "triangles", { { 0, 1, 2 }, { 0, 2, 3 } } },
             { "curves", Json::array ({ axes }) },
             { "mu", 0.3 } };
}

Json with (Json surface, const char* key, Json value)
{
    surface[key] = std::move (value);
    return surface;
}

Json without (Json surface, const char* key)
{
    surface.erase (key);
    return surface;
}

Json four (const Json& one) { return { one, one, one, one }; }
}   // namespace

TEST_CASE ("a surface is written in the graph or takes its mesh from a file", "[plan][settings]")
{
    const auto s = reads ("surface", square()).surface;
    REQUIRE (s->mesh->points.size() == 4);
    CHECK (s->mesh->points[3].isApprox (Vec3 (0, 1, 0.01)));
    CHECK (s->mesh->triangles == std::vector<std::array<int, 3>> { { 0, 1, 2 }, { 0, 2, 3 } });
    CHECK (s->frames.empty());
    REQUIRE (s->curves.size() == 1);
    REQUIRE (s->curves[0].size() == 1);
    CHECK (s->curves[0][0][2](0.01) == Approx (10.0));
    REQUIRE (s->mu.size() == 1);
    CHECK (s->mu[0](0.5) == 0.3);

    const auto from_file = reads ("surface", { { "mesh", "liver.obj" }, { "curves", Json::array ({ axes }) }, { "mu", { 0.1, 0.2, linear } } }).surface;
    CHECK (from_file->mesh->points.size() == 3);
    CHECK (from_file->mu.size() == 3);
    CHECK (from_file->mu[2](0.001) == Approx (1.0));
}

TEST_CASE ("a surface may have frames, and curves and ratios for each node", "[plan][settings]")
{
    const Json frame = { { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, -1 } };
    auto json = with (with (square(), "frames", four (frame)), "curves", { four (axes), axes });
    const auto s = reads ("surface", with (json, "mu", { 0, 0.1, 0.2, { { "power", { 2, 1 } } } })).surface;
    REQUIRE (s->frames.size() == 4);
    CHECK (s->frames[2].row (0) == Eigen::RowVector3d (0, 1, 0));
    CHECK (s->frames[2].row (2) == Eigen::RowVector3d (0, 0, -1));
    REQUIRE (s->curves.size() == 2);
    CHECK (s->curves[0].size() == 4);
    CHECK (s->curves[1].size() == 1);
    REQUIRE (s->mu.size() == 4);
    CHECK (s->mu[1](0.5) == 0.1);
    CHECK (s->mu[3](0.5) == 1.0);
}

TEST_CASE ("a surface may have frames and ratios for each tool, ratios as curves, and tools as mixes of shapes", "[plan][settings]")
{
    const Json frame = { { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, -1 } };
    const Json curve = { { "curve", { { 0, "2 mm" }, { 0.1, 0.5 } } } };
    auto json = with (with (square(), "curves", { axes, four (axes) }), "frames", { four (frame), four (frame) });
    json = with (with (json, "mu", Json::array ({ Json::array ({ curve }), { 0, 0.1, 0.2, 0.3 } })), "weights",
                 Json::array ({ { 1, 0 }, four ({ 0.25, 0.75 }), { 0, 1 } }));
    const auto s = reads ("surface", json).surface;
    CHECK (s->frames.size() == 8);
    REQUIRE (s->mu.size() == 8);
    CHECK (s->mu[3](0.001) == Approx (0.3));
    CHECK (s->mu[3](1.0) == 0.5);
    CHECK (s->mu[6](1.0) == 0.2);
    REQUIRE (s->weights.size() == 3);
    CHECK (s->weights[0].size() == 1);
    REQUIRE (s->weights[1].size() == 4);
    CHECK (s->weights[1][2] == std::vector<double> { 0.25, 0.75 });

    const auto fault = [&] (const char* key, const Json& value) { return refusal ("surface", with (json, key, value)); };
    CHECK (contains (fault ("frames", Json::array ({ four (frame) })), "/frames: it must be the frames of each of the 2 tools that have curves"));
    CHECK (contains (fault ("mu", Json::array ({ { 0.1 }, { 0.1, 0.2 } })), "/mu/1: it must be one ratio for each of the 4 nodes, or one for all"));
    CHECK (contains (fault ("mu", { { "curve", { { 0, 1 }, { 0.1, -1 } } } }), "/mu/curve/1/1: -1 is out of range"));
    CHECK (contains (fault ("weights", Json::array()), "/weights: it needs the weights of at least one tool"));
    CHECK (contains (fault ("weights", Json::array ({ { 1, 0, 0 } })), "/weights/0: it must be one share for each of the 2 tools that have curves"));
    CHECK (contains (fault ("weights", Json::array ({ { 1, 1.5 } })), "/weights/0/1: 1.5 is out of range"));
}

TEST_CASE ("every error in a surface is reported at its place", "[plan][settings]")
{
    const auto fault = [] (const char* key, const Json& value) { return refusal ("surface", with (square(), key, value)); };

    CHECK (contains (refusal ("surface", 3), ": it must be an object with"));
    CHECK (contains (fault ("curvs", 3), "/curvs: it has no 'curvs' (did you mean 'curves'?)"));

    CHECK (refusal ("surface", without (square(), "nodes")) == ": it needs `nodes`");
    CHECK (contains (fault ("nodes", 3), "/nodes: it must be a list of points"));
    CHECK (fault ("nodes", Json::array()) == "/nodes: it needs at least three nodes");
    CHECK (contains (fault ("nodes", { { 0, 0, 0 }, { 0, 0 }, { 0, 0, 0 } }), "/nodes/1: it must be three numbers"));
    CHECK (fault ("nodes", { { 0, 0, 0 }, { 0, "1 N", 0 }, { 0, 0, 0 } }) == "/nodes/1/1: its unit is N, but it must be m");

    CHECK (refusal ("surface", without (square(), "triangles")) == ": it needs `triangles`");
    CHECK (contains (fault ("triangles", 3), "/triangles: it must be a list of triangles"));
    CHECK (fault ("triangles", Json::array()) == "/triangles: it needs at least one triangle");
    CHECK (contains (fault ("triangles", { { 0, 1 } }), "/triangles/0: it must be three node numbers, such as [0, 1, 2]"));
    CHECK (fault ("triangles", { { 0, 1, 2 }, { 0, 1, 4 } }) == "/triangles/1/2: 4 is out of range: it must be from 0 to 3");
    CHECK (contains (fault ("triangles", { { 0, 1, -1 } }), "/triangles/0/2: -1 is out of range"));
    CHECK (fault ("triangles", { { 0, 1, 1.5 } }) == "/triangles/0/2: 1.5 is not a whole number");

    CHECK (contains (fault ("frames", 3), "/frames: it must be one frame for each of the 4 nodes"));
    CHECK (contains (fault ("frames", four (3)), "/frames/0: it must be three rows"));
    CHECK (contains (fault ("frames", four ({ { 1, 0, 0 }, { 0, 1 }, { 0, 0, 1 } })), "/frames/0/1: it must be three numbers"));

    CHECK (refusal ("surface", without (square(), "curves")) == ": it needs `curves`");
    CHECK (contains (fault ("curves", 3), "/curves: it must be a list of tools"));
    CHECK (fault ("curves", Json::array()) == "/curves: it needs the curves of at least one tool");
    CHECK (contains (fault ("curves", { 3 }), "/curves/0: it must be the curves of a tool"));
    CHECK (contains (fault ("curves", { { linear, linear } }), "/curves/0: it must be a triple of laws"));
    CHECK (contains (fault ("curves", Json::array ({ Json::array() })), "/curves/0: it must be a triple of laws"));
    CHECK (contains (fault ("curves", { axes, { linear, 3, linear } }), "/curves/1/1: it must be {\"power\""));
    CHECK (contains (fault ("curves", Json::array ({ Json::array ({ axes, axes }) })), "/curves/0: it must be the curves of each of the 4 nodes"));
    CHECK (contains (fault ("curves", Json::array ({ Json::array ({ axes, axes, axes, 3 }) })), "/curves/0/3: it must be a triple of laws"));

    CHECK (refusal ("surface", without (square(), "mu")) == ": it needs `mu`");
    CHECK (contains (fault ("mu", -1), "/mu: -1 is out of range"));
    CHECK (contains (fault ("mu", { 0.1, 0.2 }), "/mu: it must be one ratio for each of the 4 nodes, or one for all"));
    CHECK (contains (fault ("mu", { 0.1, 0.2, -1, 0.3 }), "/mu/2: -1 is out of range"));
    CHECK (contains (fault ("mu", { { "power", 3 } }), "/mu/power: it must be a list of two numbers"));
    CHECK (contains (fault ("mu", "3 N"), "/mu: its unit is N, but it must be 1"));

    const Json file = { { "mesh", "liver.obj" }, { "curves", Json::array ({ axes }) }, { "mu", 0 } };
    CHECK (refusal ("surface", with (file, "nodes", Json::array())) == "/nodes: give either `mesh` or `nodes`, not both");
    CHECK (refusal ("surface", with (file, "frames", Json::array())) == "/frames: give either `mesh` or `frames`, not both");
    CHECK (refusal ("surface", with (file, "mesh", "gone.obj")) == "/mesh: gone.obj: there is no such file");
    CHECK (contains (refusal ("surface", with (file, "mesh", 3)), "/mesh: it must be the path of a file"));
    CHECK (contains (refusal ("surface", file, false), "/mesh: this program cannot read 'liver.obj'"));
    CHECK (contains (refusal ("surface", with (file, "mu", { 1, 2 })), "/mu: it must be one ratio for each of the 3 nodes"));
}

TEST_CASE ("no value of a setting breaks the reader", "[plan][settings]")
{
    const std::vector<Json> scraps { nullptr,
                                     true,
                                     3,
                                     -1,
                                     1e308,
                                     "",
                                     "1 m",
                                     "a.wav",
                                     Json::array(),
                                     Json::object(),
                                     linear,
                                     axes,
                                     square(),
                                     { 0, 0, 0 },
                                     { { "mesh", "m" } },
                                     { { "frequency", 1 } } };
    test::property ("any nesting of fragments", [&] {
        Json value = *rc::gen::elementOf (scraps);
        for (int depth = *rc::gen::inRange (0, 5); depth > 0; --depth)
        {
            const auto& other = *rc::gen::elementOf (scraps);
            const auto key = *rc::gen::element<std::string> ("curves", "mu", "nodes", "triangles", "frames", "mesh", "mode", "power", "table", "coefficients");
            if (*rc::gen::arbitrary<bool>())
                value = Json::array ({ value, other, value });
            else if (value.is_object())
                value[key] = other;
            else
                value = with (square(), key.c_str(), value);
        }
        for (const auto& sheet : type().settings)
        {
            Disk disk;
            std::string where;
            const auto read = plan::readSetting (value, sheet, { &disk, "" }, where);
            if (read)
                sheet.set (type().make().get(), *read);
            else
                RC_ASSERT_FALSE (read.error().text.empty());
        }
    });
}
