// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/catalogue.hpp>
#include <tactus/text/json.hpp>

namespace tactus
{

/// The JSON schema (draft 2020-12) of graph files, for editors: what schema_base.cpp says of every graph, with the types of the catalogue,
/// their parameters, units, ranges, choices and settings, and the devices and guards. It refuses only what compile() and makeDevice()
/// refuse or warn about. It cannot see what depends on other parts of the file, such as whether a wire ends at an existing node; for
/// that there is `tactus validate`. [main thread]
Json graphSchema (const Catalogue&);

}   // namespace tactus
