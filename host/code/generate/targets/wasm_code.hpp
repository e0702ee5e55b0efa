// SPDX-License-Identifier: MIT
#pragma once

#include <host/code/generate/class/exported.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The files that make an exported class a WebAssembly module, behind its C interface (c_api_code.hpp): the functions of the module, its
/// JavaScript and the types of that. The module and its script have the digest of the export, so that they notice if they do not belong together.
std::vector<std::pair<std::string, std::string>> wasmFiles (const Exported&, std::uint32_t digest);

/// The rules for make that build and test the module.
std::string wasmMake (const Exported&);

}   // namespace tactus::host
