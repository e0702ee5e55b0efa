// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_model.hpp"

#include <tactus/text/json.hpp>

namespace tactus::host
{

/// The scopes that the user has made for a graph, as its file keeps them: the list "scopes" under `ui`. Cursors and zoomed ranges are not kept.
Json writeScopes (const std::vector<ScopeSpec>&);

/// Reads them from `ui`. Empty if it has no such list. Entries that are no scopes are left out, and numbers out of range are replaced.
std::optional<std::vector<ScopeSpec>> readScopes (const Json& ui);

}   // namespace tactus::host
