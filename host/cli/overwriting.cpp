// SPDX-License-Identifier: GPL-3.0-or-later
#include "overwriting.hpp"
#include "report.hpp"

#include <tactus/file/atomic_file.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <iostream>

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

void refuseOverwriting (const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs)
{
    for (auto out = outputs.begin(); out != outputs.end(); ++out)
    {
        const auto is_it = [&] (const std::filesystem::path& other) { return isSame (*out, other); };
        if (std::ranges::any_of (inputs, is_it))
            fail (Message::error ("output/is_input", *out, "this file is read by the run and would be overwritten", "give the output another name"));
        if (std::any_of (outputs.begin(), out, is_it))
            fail (Message::error ("output/twice", *out, "two outputs would be written to this file", "give each output its own file"));
    }
}

void reportUnfinished (const std::vector<std::string>& outputs)
{
    for (const auto& file : outputs)
        for (const auto& left : leftUnfinished (file))
            std::cerr << "note: " << inOneLine (left.string())
                      << " is what an earlier run recorded before it was killed; rename the file to keep it, or remove it\n";
}

}   // namespace tactus::host
