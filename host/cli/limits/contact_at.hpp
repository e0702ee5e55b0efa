// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/cli/checked_roles.hpp>
#include <tactus/check/spring_and_damper.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// A graph's contact under other conditions than the graph has. Empty members: as measured.
struct Conditions
{
    double rate_hz = 0.0;
    std::vector<double> params {};   ///< of Contact::varied
    std::optional<double> stiffness {}, damping {};
};

/// The stability of a contact under some conditions.
struct Standing
{
    double stiffness = 0.0;            ///< N/m
    double damping = 0.0;              ///< N s/m
    double load = 0.0;                 ///< (2d + 1) sigma T/2 + |b|, in N s/m; passive if at most B
    std::optional<double> radius {};   ///< of the sampled loop, with the worst of the usual hands; empty if it is not known
    double largest_damper = 0.0;       ///< the exact 2M/T + 4B/3, in N s/m
    double period_s = 0.0;             ///< T

    /// Below 0 where the contact is passive, rests, and keeps the two conditions of footnote 2: b < 2M/T + 4B/3, and sigma T < b + B.
    double passive (double device_damping) const { return load / device_damping - 1.0 - 1e-5; }
    double rests() const;
    double damperHolds() const { return damping / largest_damper - 1.0; }
    double footnote (double device_damping) const { return stiffness * period_s / (damping + device_damping) - 1.0; }
};

/// The steepest contact of a role: where and along which direction the load is largest. It is measured again for other params and rates, at the same
/// time of the same motion.
class Contact
{
public:
    /// The command ends if there is no contact, if it has no response that repeats on every tick, or if the device's mass or damping is not known.
    Contact (check::Subject, check::HandMotion, const std::vector<CheckedRole>&, const std::string& role);

    Standing at (const Conditions&);

    std::vector<std::string> varied;   ///< the params of Conditions::params, as NODE.PARAM

    double rate() const noexcept { return motion.rate_hz; }
    double time() const noexcept { return t_s; }                    ///< of the steepest contact, in s
    const std::string& node() const noexcept { return steepest; }   ///< the node whose own force is steepest there; its path
    const CheckedRole& device() const noexcept { return role; }
    double damping() const noexcept { return role.device.numbers.damping->value; }   ///< of the device, in N s/m

private:
    const check::SpringAndDamper& measured (double rate_hz, const std::vector<double>& params);

    check::Subject subject;
    check::HandMotion motion;
    CheckedRole role;
    double t_s = 0.0;
    std::string steepest;
    std::map<std::vector<double>, check::SpringAndDamper> known;
};

}   // namespace tactus::host
