// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/examine/no_allocation.hpp>

using tactus::examine::NoAllocation;
