// SPDX-License-Identifier: MIT
#pragma once

#include "message.hpp"

#include <string>
#include <utility>

namespace tactus
{

/// The error that answers what somebody asked for and cannot have, where no file is at fault.
inline Message refused (std::string id, std::string text, std::string remedy = {})
{
    Message m;
    m.id = std::move (id);
    m.text = std::move (text);
    m.remedy = std::move (remedy);
    return m;
}

}   // namespace tactus
