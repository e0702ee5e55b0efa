// SPDX-License-Identifier: MIT
#include "guard.hpp"
