// SPDX-License-Identifier: MIT
#include "../exercise.hpp"

#include <host/drivers/falcon/device.hpp>
#include <host/drivers/falcon/fake_falcon.hpp>

namespace tactus::test
{

namespace
{
const Exercise falcon_exercise ([] (const TemporaryFolder&) {
    using Fault = host::FakeFalcon::Fault;
    const auto& driver = host::falcon::patient_driver;
    host::FakeFalcon falcon;
    for (const auto fault : { Fault::none, Fault::shorter, Fault::shifted, Fault::noisy, Fault::changed, Fault::impossible, Fault::late })
    {
        Use use { .what = "a fault of the line", .disturb = [&] { falcon.fail (fault); }, .then = [&] { falcon.fail (Fault::none); } };
        if (fault == Fault::late) use.readings = 20;
        play (driver, falcon.port(), use);
    }
    expect (falcon.malformed == 0, "bytes outside packets");
    expect (falcon.without_homing == 0, "packets without the bit that keeps the homing");
    ::setenv ("LD_LIBRARY_PATH", (std::string (TACTUS_FAKE_LIBRARIES) + "/ftdi").c_str(), 1);
    ::setenv ("TACTUS_FAKE_FTDI", falcon.port().c_str(), 1);
    for (int i = 0; i < 3; ++i)
        play (driver, "usb", { .what = "by libftdi" });
    play (driver, falcon.port(), { .what = "unplugged", .disturb = [&] { falcon.unplug(); }, .ends_with = TACTUS_DEVICE_GONE });
});
}   // namespace

}   // namespace tactus::test
