// SPDX-License-Identifier: MIT
#include "flat.hpp"

namespace tactus::plan
{

std::string Flat::nameOf (const PortRef& r) const
{
    auto name = node (r).path + "." + std::string (sheet (r).id);
    if (r.index >= 0) name += "[" + std::to_string (r.index) + "]";
    if (r.component >= 0) name += std::string (".") + "xyz"[r.component];
    return name;
}

void Flat::error (std::string id, const Origin& origin, std::string text, std::string remedy)
{
    if (isFull()) return;
    messages.push_back ({ Message::Severity::error, std::move (id), origin.pointer, std::move (text), std::move (remedy), origin.file, 0, 0 });
}

void Flat::warn (std::string id, const Origin& origin, std::string text, std::string remedy)
{
    if (isFull()) return;
    messages.push_back ({ Message::Severity::warning, std::move (id), origin.pointer, std::move (text), std::move (remedy), origin.file, 0, 0 });
}

}   // namespace tactus::plan
