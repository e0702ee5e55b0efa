// SPDX-License-Identifier: MIT
#pragma once

#include "exchange.hpp"

#include <tactus/text/result.hpp>

#include <functional>
#include <memory>
#include <string>

namespace tactus::host
{

/// Stands between a driver and a service, passes their messages on, and hands each to a callback. One driver at a time. Runs on a thread of its own.
/// [any thread]
class ServiceRelay
{
public:
    /// Sees a message before it is passed on. [thread of the relay]
    using See = std::function<void (bool is_from_service, const std::string& message)>;

    /// Listens on a free port of this computer. Id: device/wire.
    static Result<std::unique_ptr<ServiceRelay>> make (const ServiceAddress&, See);

    virtual ~ServiceRelay() = default;

    virtual int port() const noexcept = 0;     ///< where the driver finds the service
    virtual std::string trouble() const = 0;   ///< why the service could not be reached last; empty if it could
};

}   // namespace tactus::host
