// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device.hpp>
#include <tactus/text/result.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace tactus::host
{

/// A fake of a device or of a service, without a profile, that `tactus fake-device` offers. It runs on a thread of its own. [main thread]
class OfferedFake
{
public:
    virtual ~OfferedFake() = default;

    virtual std::string where() const = 0;   ///< what to tell a person who wants to play on it
    virtual std::string heard() const = 0;   ///< what has come so far, for the end

    /// Fails in this way from now on, one of its kind's `faults`; "": in none.
    virtual void fail (std::string_view fault) = 0;
};

/// The fault with this name in a table, or `Fault::none`, which has none.
template <typename Fault, std::size_t n>
Fault faultNamed (std::string_view name, const std::pair<std::string_view, Fault> (&table)[n])
{
    const auto* found = std::ranges::find (table, name, &std::pair<std::string_view, Fault>::first);
    return found != std::end (table) ? found->second : Fault::none;
}

/// The parts that a fake is made from.
struct OfferedFakeParts
{
    std::unique_ptr<Device> hand {};
    int port = 0;                              ///< of a service; 0: a free one
    std::filesystem::path libraries {};        ///< the folder with the fakes of makers' libraries; empty: there are none
    std::filesystem::path private_folder {};   ///< for its files, which it may leave there
};

/// A kind of fake. Each driver that has one says in its own folder what it is; the list is made from calls of tactus_offer_fake in host/drivers/CMakeLists.txt.
struct OfferedFakeKind
{
    const char* name;     ///< as in `tactus fake-device NAME`
    const char* what;     ///< for people: "the Novint Falcon"
    const char* faults;   ///< with ", " between them; what one of them means may follow in brackets
    bool needs_hand;      ///< the hand moves something

    /// Id: fake/library, device/wire.
    Result<std::unique_ptr<OfferedFake>> (*make) (OfferedFakeParts);
};

/// The kinds that this program was built with.
std::span<const OfferedFakeKind* const> offeredFakes() noexcept;

}   // namespace tactus::host
