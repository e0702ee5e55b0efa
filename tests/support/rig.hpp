// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/examine/rig.hpp>

using tactus::examine::Rig;
