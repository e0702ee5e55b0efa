// SPDX-License-Identifier: MIT
#pragma once

#include <host/code/generate/class/exported.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace tactus::host
{

/// The C interface of an exported class: a C99 header, the C++ file behind it, and a C program that uses it.
struct CFiles
{
    std::string header, source, example;
};

CFiles cFiles (const Exported&);

/// The sizes in bytes of the structs for the readings and the efforts of a role, with the alignment of a C compiler for 32 or 64 bits.
std::size_t readingBytes (const DeviceLayout&);
std::size_t effortBytes (const DeviceLayout&);

/// The members of the struct for limits that are numbers.
std::vector<std::string> limitNames();

}   // namespace tactus::host
