// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/message.hpp>

#include <string>
#include <utility>

namespace tactus::host
{

inline Message problem (std::string id, std::string where, std::string text, std::string remedy)
{
    Message message;
    message.id = std::move (id);
    message.where = std::move (where);
    message.text = std::move (text);
    message.remedy = std::move (remedy);
    return message;
}

}   // namespace tactus::host
