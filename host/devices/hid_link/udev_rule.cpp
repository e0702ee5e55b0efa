// SPDX-License-Identifier: MIT
#include "udev_rule.hpp"

#include <cstdio>

namespace tactus::host::hid
{

std::string udevRule (const DeviceInfo& d)
{
    // Over Bluetooth, no parent has idVendor, but the kernel's name for the HID device contains bus, vendor and product.
    char rule[160];
    if (d.bus == Bus::bluetooth)
        std::snprintf (rule, sizeof rule, "KERNEL==\"hidraw*\", KERNELS==\"0005:%04X:%04X.*\", TAG+=\"uaccess\"", d.vid, d.pid);
    else
        std::snprintf (rule, sizeof rule, "KERNEL==\"hidraw*\", ATTRS{idVendor}==\"%04x\", ATTRS{idProduct}==\"%04x\", TAG+=\"uaccess\"", d.vid, d.pid);
    return rule;
}

std::string howToPermit (const ConnectedDevice& d)
{
    if (d.wire == Wire::serial) return "join the group of " + d.path + " (on Debian: sudo adduser $USER dialout), and log in again";
    return "write this line to /etc/udev/rules.d/70-tactus.rules:\n        " + udevRule (d)
           + "\n    then run `sudo udevadm control --reload && sudo udevadm trigger`, and plug the device in again";
}

}   // namespace tactus::host::hid
