// SPDX-License-Identifier: MIT
#pragma once

#include "checked_graph.hpp"

#include <tactus/check/measure.hpp>

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
    double load = 0.0;                 ///< exact damping that a passive contact needs (check::passivityLoad), in N s/m; passive if at most B
    std::optional<double> radius {};   ///< of the sampled loop, with the worst of the usual hands; empty if it is not known
    double largest_damper = 0.0;       ///< the exact 2M/T + 4B/3, in N s/m
    double period_s = 0.0;             ///< T
    double stiffest_held = 0.0;        ///< 2 f_f/delta, in N/m; up to it, a held tool does not hunt between steps; infinite without steps, nan if unknown
    double quietest_damper = 0.0;      ///< f_f T/delta, in N s/m; up to it, steps of the sensor give no blows if the speed is that of one tick; likewise

    /// Below 0 where the contact is passive, rests, and keeps the two conditions of footnote 2: b < 2M/T + 4B/3, and sigma T < b + B.
    double passive (double device_damping) const { return load / device_damping - 1.0 - 1e-5; }
    double rests() const;
    double damperHolds() const { return damping / largest_damper - 1.0; }
    double isHeld() const { return stiffness / stiffest_held - 1.0; }
    double isQuiet() const { return damping / quietest_damper - 1.0; }
    double footnote (double device_damping) const { return stiffness * period_s / (damping + device_damping) - 1.0; }
};

/// The heaviest contact of a role or of an axis: the place with the largest load, in all directions together. Of several such places, it is the one with the
/// largest force. For other params and rates, it is measured again: the tool takes the same path to exactly the same place. With another param, the tool
/// is then pressed in or let out until its force is as before.
///
/// The params `stiffness` and `damping` of the steepest node that has them vary the contact. The change that such a param makes to the response is
/// measured along the node's own force, so a filter or a hold after the node counts, and a friction that slides under its load does not. Without such a
/// param, the whole response grows with the stiffness, and a damper along the steepest direction is added, or along all that are as steep.
class Contact
{
public:
    /// Refuses if there is no contact, if it has no response that repeats on every tick, or if the device's mass or damping is not known.
    Contact (check::Subject, check::HandMotion, const std::vector<CheckedRole>&, const Plan&, const std::string& role);

    Standing at (const Conditions&);

    std::vector<std::string> varied;   ///< the params of Conditions::params, as NODE.PARAM

    double rate() const noexcept { return motion.rate_hz; }
    double time() const noexcept { return t_s; }                    ///< of the contact, in s
    const std::string& node() const noexcept { return steepest; }   ///< the node whose own force is steepest there; its path
    /// Another node whose loop swings there, or is nearer to swinging, which what is varied may not cure, and how many times its response could be as large.
    struct Weakest
    {
        std::string node;
        double may_grow = 0.0;
    };
    const std::optional<Weakest>& weakest() const noexcept { return its_weakest; }
    const std::string& controller() const noexcept { return its_controller; }        ///< a safety.passivity of the graph: the loop depends on its state
    const std::string& stiffnessParam() const noexcept { return stiffness_param; }   ///< varied, as NODE.PARAM; empty: the whole response
    const std::string& dampingParam() const noexcept { return damping_param; }       ///< the same; empty: a damper is added
    const CheckedRole& device() const noexcept { return role; }                      ///< of the role; with the numbers of the axis if the contact is on an axis
    const std::string& axis() const noexcept { return its_axis; }                    ///< empty: of the tool
    double damping() const noexcept { return role.device.numbers.damping->value; }   ///< of the device, in N s/m

private:
    using Response = std::vector<check::Jacobian>;   // tick by tick, three rows and columns

    /// A response that grows with two numbers: rest + stiffness * spring + damping * damper. Without a rest, it is not known.
    struct Model
    {
        double stiffness = 0.0, damping = 0.0;   // as measured
        Response rest, spring, damper;
    };

    struct Measured
    {
        Response response;
        double stiffness = 0.0, damping = 0.0;
        Vec3 force = Vec3::Zero();   // where the tool stays
    };

    Measured measured (double rate_hz, const std::vector<double>& params, const std::vector<plan::Override>& more);
    const Measured& asIs (double rate_hz, const std::vector<double>& params);
    const Model& model (double rate_hz, const std::vector<double>& params);
    check::HandMotion pressedBy (const Vec3& shift, double rate_hz) const;
    void findParams (const check::Demand&, const check::Slope&, const Plan&);

    check::Subject subject;
    check::HandMotion motion;
    CheckedRole role;
    std::string its_axis;
    double t_s = 0.0;
    check::HandMotion way;   // to the place, where the tool stays
    std::string steepest;
    Eigen::Matrix3d acts = Eigen::Matrix3d::Identity();   // projection on the directions in which the steepest node acts; a param changes these
    std::optional<Weakest> its_weakest;
    std::string its_controller;
    std::string stiffness_param, damping_param;   // NODE.PARAM; empty: the contact has none
    double stiffness_set = 0.0, damping_set = 0.0;
    std::map<std::vector<double>, Measured> known;
    std::map<std::vector<double>, Model> models;
};

}   // namespace tactus::host
