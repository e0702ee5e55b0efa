// SPDX-License-Identifier: MIT
#include "support/tested_types.hpp"

const tactus::Catalogue& tactus::test::testedTypes() { return catalogue(); }
