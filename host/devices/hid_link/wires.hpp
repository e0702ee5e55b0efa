// SPDX-License-Identifier: MIT
#pragma once

#include "transport.hpp"

#include <memory>
#include <string>

namespace tactus::host::hid
{

/// Opens a device at the other end of a wire that is not HID. The reports are those of its profile, byte for byte: on a serial line in frames
/// (writeFrame), over UDP one in each datagram. A report id is the first byte; without ids, the leading 0 of HID is not sent.
///
/// Nothing here waits for the device to take a report: a report that the line has no room for is refused, because a queue of forces is a
/// delay.
///
/// A UDP device sends its reports to the address from which the last datagram came. So it gets an empty datagram when it is opened, and after
/// each 100 ms of silence. It counts as gone if it does not answer within 200 ms of being opened, or is silent for a second (unless its
/// profile says that it reports only changes). A datagram with an earlier number than the last one is dropped.
///
/// A device that only answers (framing `answer`) gets one report with a force at a time. If no answer comes within 20 ms, the device may have missed a part
/// of the report: it gets fillers, which end it, and the neutral report; without a filler in its profile, it gets the neutral report after a pause of 100 ms.
/// After about a second without an answer, it counts as gone. While there is nothing to send, it gets the neutral report every 100 ms. These times are
/// measured by the clock of the system, which must outlive the transport.
///
/// Ids: hid/not_permitted, hid/not_opened; the text is the reason. [main thread, or the reading thread of a port]
Result<std::unique_ptr<Transport>> openWire (const ConnectedDevice&, const Profile&, const HidSystem&);

/// A name of a serial port that stays the same when the port is plugged in again: the link in `by_id` that leads to the port, or the port's own
/// name if there is no such link.
std::string lastingNameOf (const std::string& port, const std::string& by_id = "/dev/serial/by-id");

}   // namespace tactus::host::hid
