// SPDX-License-Identifier: MIT
#pragma once

/// The texts of wires, under the name that this header had in 0.2.0: the examples of that release include it (tests/releases).
#include "endpoint_text.hpp"
