// SPDX-License-Identifier: MIT
#include "overwriting.hpp"

#include <algorithm>

namespace tactus::host
{

namespace
{
/// True for the same name, or for two names that the file system resolves to the same file.
bool isSame (const std::filesystem::path& a, const std::filesystem::path& b)
{
    std::error_code failed;
    return a.lexically_normal() == b.lexically_normal() || std::filesystem::equivalent (a, b, failed);
}
}   // namespace

Result<> checkOverwriting (const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs)
{
    for (auto out = outputs.begin(); out != outputs.end(); ++out)
    {
        const auto is_it = [&] (const std::filesystem::path& other) { return isSame (*out, other); };
        if (std::ranges::any_of (inputs, is_it))
            return Message::error ("output/is_input", *out, "this file is read by the run and would be overwritten", "give the output another name");
        if (std::any_of (outputs.begin(), out, is_it))
            return Message::error ("output/twice", *out, "two outputs would be written to this file", "give each output its own file");
    }
    return {};
}

}   // namespace tactus::host
