// SPDX-License-Identifier: MIT
#pragma once

#include <host/generate/class/exported.hpp>

#include <string>

namespace tactus::host
{

/// The C interface of an exported class: a C99 header, the C++ file behind it, and a C program that uses it.
struct CFiles
{
    std::string header, source, example;
};

CFiles cFiles (const Exported&);

}   // namespace tactus::host
