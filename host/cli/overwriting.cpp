// SPDX-License-Identifier: GPL-3.0-or-later
#include "overwriting.hpp"
#include "report.hpp"

#include <host/base/files/overwriting.hpp>
#include <tactus/file/atomic_file.hpp>

#include <iostream>

namespace tactus::host
{

void refuseOverwriting (const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs)
{
    orFail (checkOverwriting (outputs, inputs));
}

void reportUnfinished (const std::vector<std::string>& outputs)
{
    for (const auto& file : outputs)
        for (const auto& left : leftUnfinished (file))
            std::cerr << "note: " << inOneLine (left.string())
                      << " is what an earlier run recorded before it was killed; rename the file to keep it, or remove it\n";
}

}   // namespace tactus::host
