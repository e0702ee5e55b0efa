// SPDX-License-Identifier: MIT
#include "adapted_source.hpp"
#include "code.hpp"

namespace tactus::host
{

namespace
{
/// Exported code may be compiled by anything, so it does not rely on a flag to have the bits of Tactus.
constexpr const char* scalar_eigen = R"(#if defined(EIGEN_CORE_H) && ! defined(EIGEN_DONT_VECTORIZE)
#error "Eigen is included before this graph: compile with -DEIGEN_DONT_VECTORIZE, or include the header of the graph first"
#elif ! defined(EIGEN_DONT_VECTORIZE)
#define EIGEN_DONT_VECTORIZE
#endif
#include <Eigen/Core>
)";

/// True for "std::string axis" and "std::string text = "in0"": a setting that is a text.
bool isTextMember (std::string_view line)
{
    constexpr std::string_view type = "        std::string ";
    return line.starts_with (type) && line.ends_with (';') && line.find_first_of ("({") == line.npos;
}

/// Settings that are texts become views of literals.
std::string withTextViews (const std::string& text)
{
    std::string all;
    for (std::size_t i = 0; i < text.size();)
    {
        const auto end = std::min (text.find ('\n', i), text.size() - 1);
        std::string line = text.substr (i, end - i);
        if (isTextMember (line)) line.replace (line.find ("std::string"), 11, "std::string_view");
        all += line + "\n";
        i = end + 1;
    }
    return all;
}
}   // namespace

std::string adapted (const SourceFile& file)
{
    const std::string before (file.text);
    if (file.path == "tactus/kit/vec3.hpp") return filled (before, { { "#include <Eigen/Core>\n", scalar_eigen } });
    const bool is_of_plugin = file.path.starts_with ("plugins/");
    if (file.path == "tactus/run/generated/exported_memory.hpp" || ! (is_of_plugin || file.path.starts_with ("tactus/"))) return before;
    auto text = filled (before, { { "std::vector<std::string>", "tactus::exported::NameList" },
                                  { "std::vector<", "tactus::exported::Vector<" },
                                  { "std::map<", "tactus::exported::Map<" },
                                  { "std::function<", "tactus::exported::Function<" },
                                  { "std::unique_ptr<", "std::shared_ptr<" },
                                  { "std::make_unique<", "tactus::exported::makeShared<" },
                                  { "std::make_shared<", "tactus::exported::makeShared<" } });
    // Exported code binds its nodes before they tick, so a device for those without one would only take memory.
    text = filled (text, { { "inline const DeviceState no_device { .reading = { .valid = false }, .applied = {} };\n", "" }, { "&no_device", "nullptr" } });
    // Exported code sets all settings, so the default surface would only take memory. It would outlive the graph whose memory it uses.
    text = filled (text, { { "surface = pad();", "surface;" }, { "static const auto made = [] {", "const auto made = [] {" } });
    if (is_of_plugin || file.path.starts_with ("tactus/nodes/")) text = withTextViews (text);
    if (text == before) return text;
    text = filled (text, { { "#include <vector>\n", "" } });
    const auto place = text.find ("#include");
    if (place != text.npos) text.insert (place, "#include <tactus/run/generated/exported_memory.hpp>\n");
    return text;
}

}   // namespace tactus::host
