// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_device.h>

#include <cstdint>
#include <exception>
#include <string>

namespace tactus::host
{

/// Says why a function of a driver has failed, and returns that it has.
inline int32_t failed (const tactus_plugin_report* report, const std::string& why)
{
    report->put (report->context, why.data(), why.size());
    return TACTUS_DEVICE_FAILED;
}

/// Calls the body of a function of a driver, which no exception may leave.
template <typename F>
int32_t answered (const tactus_plugin_report* report, F&& body) noexcept
{
    try
    {
        return body();
    }
    catch (const std::exception& e)
    {
        return failed (report, e.what());
    }
}

}   // namespace tactus::host
