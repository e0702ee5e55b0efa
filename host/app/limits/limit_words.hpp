// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/check/judge.hpp>

#include <string>

namespace tactus::host
{

/// True for a contact whose slopes are more than what is passive, and whose sampled loop comes to rest with usual hands.
bool isPastPassivity (const check::Condition&);

/// True for a contact that is more damped than stiff, as far as its condition goes. Not if several nodes have loops of their own.
bool isMostlyDamping (const check::Condition&);

/// 5.1, 42, 4200: two digits, and no exponent; three near 1.
std::string twoDigits (double);

/// A limit in one sentence, without its laws: "The stiffness of wall is 5.1 times what stylus (simulated) allows". `node` is what the limit is about;
/// empty: the whole role. A number has two digits, three near 1.
std::string limitSentence (const check::Condition&, const std::string& node, const std::string& device);

/// The first of the things that would help, with numbers that need no exponent; empty if nothing is known.
std::string firstRemedy (const check::Condition&);

}   // namespace tactus::host
