// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace tactus::check
{

/// A contact at one place and in one direction, as a spring and a damper whose strengths can be varied apart. As measured, the two together have
/// the response of the contact.
struct SpringAndDamper
{
    double stiffness = 0.0;          ///< as measured, in N/m
    double damping = 0.0;            ///< as measured, in N s/m
    double period_s = 0.0;           ///< T
    std::vector<double> spring {};   ///< the response of a spring of 1 N/m, tick by tick, in N/m
    std::vector<double> damper {};   ///< that of a damper of 1 N s/m

    /// The response of this contact with another stiffness and damping, in N/m.
    std::vector<double> response (double stiffness_n_m, double damping_ns_m) const;

    /// The damping that the device must have so that this contact is passive: (2d + 1) sigma T/2 + |b|, in N s/m. `delay_ticks` is that of the
    /// device.
    double load (double stiffness_n_m, double damping_ns_m, double delay_ticks) const;
};

/// Divides the response of a contact (Slope::responses). The damper is what is in excess of the settled force; without any, it is the last change of
/// the position, as late as the first force. What is missing while the force comes late belongs to the spring. [any thread]
SpringAndDamper springAndDamper (std::span<const double> response, double period_s);

}   // namespace tactus::check
