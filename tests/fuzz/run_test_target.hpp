// SPDX-License-Identifier: MIT
#pragma once

#include "whole_error.hpp"

#include <tactus/run/log/run_test.hpp>

#include <cstdlib>
#include <sstream>
#include <string>

namespace tactus::fuzz
{

/// Reads the text as a test of a run: its head and the expected values. Either both are complete, or reading reports an error with its
/// location. Aborts otherwise. The rest of the file is a log, which run_log_target.hpp reads.
inline void tryRunTest (std::string_view text)
{
    std::istringstream in { std::string (text) };
    const auto head = readRunTestHead (in, "fuzz.jsonl");
    if (! head) return checkWhole (head.error());
    if (head->until <= head->from || head->ports.empty()) std::abort();
    const auto expected = readExpected (in, *head, "fuzz.jsonl");
    if (! expected) return checkWhole (expected.error());
    if (expected->size() != (head->until - head->from) * head->ports.size()) std::abort();
}

}   // namespace tactus::fuzz
