// SPDX-License-Identifier: MIT
#include "examination.hpp"
#include "parts.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace tactus::examine
{

namespace
{
std::string always (const NodeType&) { return {}; }

constexpr auto list = std::to_array<Examination> ({
    { "hooks", "every hook returns, and the node accepts its own defaults", 1, false, &always, &hookFault },
    { "datasheet", "every default is in its range, and no name occurs twice", 1, false, &always, &sheetFault },
    { "sizes", "it writes nothing past the end of its outputs", 1, false, &always, &sizeFault },
    { "finite", "finite inputs give finite outputs, with any params in their range", 1, true, &always, &rangeFault },
    { "nan", "an input that is not finite gives 0, and the next tick is as before", 1, true, &noInputs, &nanFault },
    { "bits", "two fresh instances give the same bits", 1, true, &always, &repeatFault },
    { "instances", "two instances that tick in turn do not affect each other", 1, true, &always, &instanceFault },
    { "allocations", "a tick allocates and frees no memory", 1, false, &unwatched, &allocationFault },
    { "locks", "a tick locks no mutex", 1, false, &unwatched, &lockFault },
    { "system_calls", "a tick does not call the operating system", 1, false, &callsUnwatched, &systemCallFault },
    { "amplitude", "no output exceeds the claimed amplitude", 1, true, &noClaims, &amplitudeFault },
    { "revival", "every output works again after an input was not finite", 2, false, &noInputs, &revivalFault },
    { "memory", "a node without a memory does not remember that an input was not finite", 2, false, &peeks, &memoryFault },
    { "adopt", "a new instance continues exactly where the old one stopped", 2, true, &noAdopt, &adoptFault },
    { "state", "a restored state goes on with the same bits, and a damaged one does no harm", 2, true, &noState, &stateFault },
    { "passive", "a node that claims to be passive generates no energy on a closed path", 3, true, &notMechanical, &passiveFault },
    { "threads", "two instances that tick in two threads do not affect each other", 3, true, &always, &threadFault },
});
}   // namespace

std::span<const Examination> examinations() noexcept { return list; }

const Examination& examination (std::string_view id)
{
    const auto at = std::ranges::find (list, id, &Examination::id);
    if (at == list.end()) throw std::invalid_argument ("there is no examination " + quote (id));
    return *at;
}

int trialsAt (int level) noexcept
{
    static constexpr int trials[] { 5, 10, 25, 50, 100, 200, 400, 700, 1000, 2000 };
    return trials[std::clamp (level, 1, 10) - 1];
}

}   // namespace tactus::examine
