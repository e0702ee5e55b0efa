// SPDX-License-Identifier: MIT
#include "contact_at.hpp"
#include "refusal.hpp"

#include <tactus/check/factors.hpp>
#include <tactus/check/measure.hpp>
#include <tactus/check/sampled_loop.hpp>
#include <tactus/check/stretches.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace tactus::host
{

namespace
{
/// The tick period of the loop, in s. A device that is slower than the graph holds each force for longer.
double periodOf (const DeviceNumbers& n, double rate_hz)
{
    return n.rate && n.rate->value > 0.0 ? std::max (1.0 / n.rate->value, 1.0 / rate_hz) : 1.0 / rate_hz;
}

using Response = std::vector<check::Jacobian>;

/// The damping that the device needs for a passive loop with this response, in N s/m.
double loadOf (const Response& response, const DeviceNumbers& numbers, double period_s)
{
    const std::array<const DeviceNumbers*, 3> axes { &numbers, &numbers, &numbers };
    constexpr std::array<double, 3> whole { 1.0, 1.0, 1.0 };
    return check::passivityLoad (response, axes, whole, period_s).value_or (0.0);
}

/// a + factor * b, tick by tick. The shorter response goes on with its last value.
Response sum (const Response& a, double factor, const Response& b)
{
    Response all;
    for (std::size_t k = 0; k < std::max (a.size(), b.size()); ++k)
    {
        check::Jacobian m = check::Jacobian::Zero (3, 3);
        if (! a.empty()) m += a[std::min (k, a.size() - 1)];
        if (! b.empty()) m += factor * b[std::min (k, b.size() - 1)];
        all.push_back (std::move (m));
    }
    return all;
}

Response scaled (double factor, const Response& r) { return sum ({}, factor, r); }

double sizeOf (const Response& r)
{
    double most = 0.0;
    for (const auto& m : r)
        most = std::max (most, m.norm());
    return most;
}

/// The largest factor by which a matrix stretches a vector.
double stretch (const check::Jacobian& m)
{
    const Eigen::MatrixXd square = m.transpose() * m;
    return std::sqrt (std::max (0.0, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> (square).eigenvalues().maxCoeff()));
}

/// The part of a response in some directions, to steps in these directions.
Response within (const Eigen::Matrix3d& directions, const Response& r)
{
    Response all;
    for (const auto& m : r)
        all.emplace_back (directions * m * directions);
    return all;
}

/// A response without a coupling that goes only one way: a force across some directions that depends on steps along them, or the reverse, but not both. A
/// friction that slides along a wall has less force the less it is pressed. The loops along and across have the same eigenvalues without it.
check::Jacobian withoutOneWay (const Eigen::Matrix3d& along, const check::Jacobian& m)
{
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along, there = along * m * across, back = (across * m * along).transpose();
    constexpr double absent = 0.1;   // relative
    if (! (std::min (there.norm(), back.norm()) < absent * std::max (there.norm(), back.norm()))) return m;
    return along * m * along + across * m * across;
}

/// The projection on the directions in which a symmetric matrix has at least this share of its largest eigenvalue.
Eigen::Matrix3d strongest (const Eigen::Matrix3d& m, double share)
{
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts (m);
    Eigen::Matrix3d all = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 3; ++i)
        if (parts.eigenvalues()[i] >= share * parts.eigenvalues()[2]) all += parts.eigenvectors().col (i) * parts.eigenvectors().col (i).transpose();
    return all;
}

/// The excess of a response over its settled force, integrated over time, in N s/m.
check::Jacobian excessOf (const Response& r, double period_s)
{
    check::Jacobian all = check::Jacobian::Zero (3, 3);
    for (const auto& m : r)
        all += period_s * (m - r.back());
    return all;
}

void requireNumber (const check::RoleDevice& device, const DeviceNumbers::Number& number, const std::string& name)
{
    if (number && number->value > 0.0) return;
    refuse (Message::error ("limits/unknown", printableName (device.role) + " on " + printableName (device.name), "the " + name + " of the device is not known",
                            "add it to \"physics\" in its profile, or name another device: --device " + device.role + "=PROFILE"));
}
}   // namespace

double Standing::rests() const { return radius ? *radius - check::at_rest : std::numeric_limits<double>::quiet_NaN(); }

Contact::Contact (check::Subject s, check::HandMotion m, const std::vector<CheckedRole>& roles, const Plan& plan, const std::string& chosen)
    : subject (std::move (s)), motion (std::move (m))
{
    const auto demand = check::measure (subject, motion);
    double most = 0.0, most_pressed = 0.0;
    bool is_known = false, is_felt = false;
    const check::Slope* heaviest = nullptr;
    Response heaviest_response;
    for (std::size_t r = 0; r < demand.roles.size(); ++r)
    {
        if (! chosen.empty() && demand.roles[r].role != chosen) continue;
        auto candidate = *std::ranges::find (roles, demand.roles[r].role, [] (const CheckedRole& c) { return c.device.role; });
        candidate.device.numbers = check::numbersFor ({ &candidate.device, 1 }, demand.roles[r]);
        Response last;
        double load = 0.0;
        for (std::size_t i = 0; i < demand.roles[r].slopes.size(); ++i)
        {
            const auto& slope = demand.roles[r].slopes[i];
            if (slope.stiffness == 0.0 && slope.damping == 0.0) continue;
            is_felt = true;
            if (demand.linked[i].responses.empty()) continue;
            Response response;
            for (const auto& now : demand.linked[i].responses)
                response.emplace_back (now.block (static_cast<Eigen::Index> (3 * r), static_cast<Eigen::Index> (3 * r), 3, 3));
            if (last.empty() || sizeOf (sum (response, -1.0, last)) > 1e-6 * sizeOf (response))   // many places have the same
                load = loadOf (response, candidate.device.numbers, 1.0 / motion.rate_hz);
            last = response;
            constexpr double same = 1e-3;
            if (is_known && (load < (1.0 - same) * most || (load <= (1.0 + same) * most && slope.force.norm() <= most_pressed))) continue;
            is_known = true;
            most = std::max (most, load);
            most_pressed = slope.force.norm();
            role = candidate;
            its_axis = demand.roles[r].axis;
            t_s = slope.t_s;
            heaviest = &slope;
            heaviest_response = response;
        }
    }
    if (! is_felt)
        refuse (Message::error ("limits/no_contact", "", "the hand feels no force that depends on its position, so there is nothing to limit",
                                "another motion of the hand: --sweep, --device ROLE=gesture:NAME or --device ROLE=trace:FILE.csv; or another --role"));
    if (! is_known)
        refuse (Message::error ("limits/no_loop", "",
                                "the force takes more than 64 ticks to settle after a step of the tool, or does not respond in the same way on every "
                                "tick, so its loop is not known",
                                "a filter with a higher cutoff, or a lower --rate; sections that run on every tick: leave out `every`; or choose "
                                "another --role"));
    requireNumber (role.device, role.device.numbers.mass, "mass");
    requireNumber (role.device, role.device.numbers.damping, "damping");
    way = motion;
    const double tick = std::clamp (t_s * motion.rate_hz, 0.0, static_cast<double> (motion.ticks) - 1.0);
    const auto before = static_cast<std::size_t> (tick), after = std::min (before + 1, motion.ticks - 1);
    for (auto& its : way.roles)
    {
        auto last = its.readings[before];
        const auto& next = its.readings[after];
        const double part = tick - static_cast<double> (before);
        last.position += part * (next.position - last.position);
        last.true_position += part * (next.true_position - last.true_position);
        for (int i = 0; i < static_cast<int> (its.layout.axes.size()); ++i)
            last.axes.set (i, last.axes[i] + part * (next.axes[i] - last.axes[i]));
        its.readings.resize (before + 1);
        its.readings.resize (before + 1 + static_cast<std::size_t> (std::ceil (0.1 * motion.rate_hz)), last);
    }
    way.ticks = way.roles.front().readings.size();
    findParams (demand, *heaviest, plan);
    if (const auto at = std::ranges::find (demand.nodes, "safety.passivity", &check::MeasuredNode::type); at != demand.nodes.end() && demand.roles.size() == 1)
        its_controller = at->path;
    const auto loops = check::nodeLoops (*heaviest, heaviest_response, role.device.numbers, periodOf (role.device.numbers, motion.rate_hz));
    for (const auto& loop : loops)   // the weakest first
        if (const auto& path = demand.nodes[loop.along.node].path; path != steepest && (&loop == &loops.front() || loop.may_grow < 1.0))
        {
            its_weakest = { path, loop.may_grow };
            break;
        }
}

/// Chooses the params to vary: those of the steepest node that has them, if they change the response.
void Contact::findParams (const check::Demand& demand, const check::Slope& slope, const Plan& plan)
{
    std::vector<std::size_t> nodes (slope.by_node.size());
    std::iota (nodes.begin(), nodes.end(), std::size_t { 0 });
    std::ranges::stable_sort (nodes, std::ranges::greater {}, [&] (std::size_t n) { return slope.by_node[n]; });
    if (nodes.empty() || ! (slope.by_node[nodes.front()] > 0.0)) return;
    steepest = demand.nodes[nodes.front()].path;
    const Eigen::Vector3d direction = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> (slope.pulls[nodes.front()]).eigenvectors().col (2);
    constexpr double along = 0.1;   // less acts across it
    std::erase_if (nodes, [&, least = along * slope.by_node[nodes.front()]] (std::size_t n) {
        return ! (direction.dot (slope.pulls[n] * direction) > least * least);
    });
    acts = strongest (slope.pulls[nodes.front()], along * along);
    const auto changes = [&] (const std::string& param, double value) {
        const auto base = asIs (motion.rate_hz, {}).response, other = measured (motion.rate_hz, {}, { { param, Json (value) } }).response;
        return ! other.empty() && sizeOf (sum (other, -1.0, base)) > 1e-4 * sizeOf (base);
    };
    constexpr std::size_t most_tried = 6;
    for (std::size_t i = 0; i < std::min (most_tried, nodes.size()) && slope.by_node[nodes[i]] > 0.0; ++i)
    {
        const auto n = nodes[i];
        const auto& path = demand.nodes[n].path;
        const auto has = [&] (std::string_view id, std::string_view unit) {
            const auto& rows = plan.flat().nodes[n].type->params;
            const auto row = std::ranges::find (rows, id, &PortSheet::id);
            return row != rows.end() && row->width == 1 && row->unit.unit.symbol == unit;
        };
        if (stiffness_param.empty() && has ("stiffness", "N/m"))
            if (const double set = check::valueInFile (plan, n, "stiffness", 0.0); set > 0.0 && changes (path + ".stiffness", 1.01 * set))
            {
                stiffness_param = path + ".stiffness";
                stiffness_set = set;
            }
        if (damping_param.empty() && has ("damping", "N*s/m"))
            if (const double set = check::valueInFile (plan, n, "damping", 0.0); changes (path + ".damping", set + 0.1 * damping()))
            {
                damping_param = path + ".damping";
                damping_set = set;
            }
    }
}

Contact::Measured Contact::measured (double rate_hz, const std::vector<double>& params, const std::vector<plan::Override>& more)
{
    auto changed = subject;
    changed.options.rate_hz = rate_hz;
    std::string where;
    for (std::size_t i = 0; i < params.size(); ++i)
    {
        changed.options.overrides.push_back ({ varied[i], Json (params[i]) });
        addToList (where, varied[i] + "=" + numberText (params[i]));
    }
    changed.options.overrides.insert (changed.options.overrides.end(), more.begin(), more.end());
    for (const auto& message : compile (changed.graph, changed.catalogue, changed.options).messages)
        if (message.severity == Message::Severity::error)
            refuse (Message::error (message.id,
                                    (where.empty() ? "" : where + ", ") + numberText (rate_hz) + " Hz" + (message.where.empty() ? "" : ", " + message.where),
                                    message.text, message.remedy));
    const bool is_base = params.empty() && more.empty();
    const Vec3 pressed = is_base || ! its_axis.empty() ? Vec3 (Vec3::Zero()) : asIs (rate_hz, {}).force;
    Measured found;
    Vec3 shift = Vec3::Zero();
    constexpr int most_tries = 8;
    constexpr double same_force = 5e-3;
    for (int i = 0; i < most_tries; ++i)
    {
        const auto demand = check::measure (changed, pressedBy (shift, rate_hz), { .at_s = static_cast<double> (way.ticks) / way.rate_hz });
        const auto at = std::ranges::find_if (demand.roles, [&] (const check::RoleDemand& d) { return d.role == role.device.role && d.axis == its_axis; });
        if (at->slopes.empty() || demand.linked.empty()) return found;
        const auto first = static_cast<Eigen::Index> (3 * (at - demand.roles.begin()));
        found.response.clear();
        for (const auto& now : demand.linked.front().responses)
            found.response.emplace_back (withoutOneWay (acts, now.block (first, first, 3, 3)));
        if (found.response.empty()) return found;
        found.stiffness = stretch (found.response.back());
        found.damping = at->slopes.front().damping;
        found.force = at->slopes.front().force;
        const double wanted = pressed.norm();
        if (! (wanted > 0.0)) break;
        const Vec3 out = pressed / wanted;
        const double missing = wanted - found.force.dot (out), slope = out.dot (Mat3 (found.response.back()) * out);
        if (std::abs (missing) <= same_force * wanted || ! (slope > 0.0)) break;
        constexpr double longest = 2e-3;   // m at a time
        shift -= std::clamp (missing / slope, -longest, longest) * out;
    }
    return found;
}

/// The way to the place, and from there by a shift, slowly.
check::HandMotion Contact::pressedBy (const Vec3& shift, double rate_hz) const
{
    auto its = way;
    for (auto& moved : its.roles)
    {
        if (moved.role != role.device.role || shift.isZero (0.0)) continue;
        const auto last = moved.readings.size() - 1, begin = last - static_cast<std::size_t> (std::ceil (0.1 * motion.rate_hz)) + 1;
        for (auto k = begin; k <= last; ++k)
        {
            const double part = std::min (1.0, 2.0 * static_cast<double> (k - begin) / static_cast<double> (last - begin + 1));
            moved.readings[k].position += part * shift;
            moved.readings[k].true_position += part * shift;
        }
    }
    return rate_hz == its.rate_hz ? its : check::atRate (its, rate_hz);
}

const Contact::Measured& Contact::asIs (double rate_hz, const std::vector<double>& params)
{
    auto key = params;
    key.push_back (rate_hz);
    if (const auto found = known.find (key); found != known.end()) return found->second;
    return known.emplace (std::move (key), measured (rate_hz, params, {})).first->second;
}

const Contact::Model& Contact::model (double rate_hz, const std::vector<double>& params)
{
    auto key = params;
    key.push_back (rate_hz);
    if (const auto found = models.find (key); found != models.end()) return found->second;
    const auto& base = asIs (rate_hz, params);
    if (base.response.empty()) return models[std::move (key)];
    const double period_s = 1.0 / rate_hz;
    Model m { .stiffness = base.stiffness, .damping = base.damping, .rest = {}, .spring = {}, .damper = {} };
    const auto ownOf = [&] (const Response& change) {   // of the node, unless most of it is elsewhere
        constexpr double most = 0.5;
        auto own = within (acts, change);
        return sizeOf (own) < most * sizeOf (change) ? change : own;
    };
    const auto valueOf = [&] (const std::string& param, double set) {   // the one that is varied along an axis, too
        const auto i = std::ranges::find (varied, param) - varied.begin();
        return static_cast<std::size_t> (i) < params.size() ? params[static_cast<std::size_t> (i)] : set;
    };
    m.rest = base.response;
    if (! damping_param.empty())
    {
        const double b = valueOf (damping_param, damping_set), more = 0.1 * damping();
        const auto other = measured (rate_hz, params, { { damping_param, Json (b + more) } });
        if (other.response.empty()) return models[std::move (key)];
        m.damper = scaled (1.0 / more, ownOf (sum (other.response, -1.0, base.response)));
        const double each = stretch (excessOf (m.damper, period_s));
        if (each > 0.0)
        {
            m.damper = scaled (1.0 / each, m.damper);
            m.damping = b * each;
            m.rest = sum (m.rest, -m.damping, m.damper);
        }
    }
    if (! stiffness_param.empty())
    {
        const double k = valueOf (stiffness_param, stiffness_set);
        if (k > 0.0)
        {
            const auto other = measured (rate_hz, params, { { stiffness_param, Json (1.01 * k) } });
            if (other.response.empty()) return models[std::move (key)];
            const auto change = scaled (100.0, ownOf (sum (other.response, -1.0, base.response)));   // of all of the param
            if (const double of_param = change.empty() ? 0.0 : stretch (change.back()); of_param > 0.0)
            {
                m.spring = scaled (1.0 / of_param, change);
                m.rest = sum (m.rest, -of_param, m.spring);
                m.stiffness = of_param;
            }
        }
    }
    constexpr double rounding = 1e-6;
    if (sizeOf (m.rest) <= rounding * sizeOf (base.response)) m.rest = scaled (0.0, m.rest);
    if (m.spring.empty() && base.stiffness > 0.0)   // no param: the whole response
    {
        m.spring = scaled (1.0 / base.stiffness, m.rest);
        m.rest = scaled (0.0, m.rest);
        m.stiffness = base.stiffness;
    }
    if (m.damper.empty())   // a damper along the steepest direction, or along all that are as steep, from one tick to the next
    {
        constexpr double as_steep = 0.9;
        const Eigen::Matrix3d last = base.response.back(), z = Eigen::Vector3d::UnitZ().asDiagonal();
        m.damper.emplace_back ((base.stiffness > 0.0 ? strongest (last.transpose() * last, as_steep * as_steep) : z) / period_s);
        m.damper.emplace_back (check::Jacobian::Zero (3, 3));
        m.damping = 0.0;
    }
    return models.emplace (std::move (key), std::move (m)).first->second;
}

Standing Contact::at (const Conditions& c)
{
    const double rate_hz = c.rate_hz > 0.0 ? c.rate_hz : motion.rate_hz;
    const auto& numbers = role.device.numbers;
    const double period_s = periodOf (numbers, rate_hz);
    const bool varies = c.stiffness || c.damping;
    const auto& m = model (rate_hz, c.params);
    if (m.rest.empty())
    {
        const double unknown = std::nan ("");
        return { .stiffness = c.stiffness.value_or (unknown), .damping = c.damping.value_or (unknown), .load = unknown, .period_s = period_s };
    }
    Standing s { .stiffness = c.stiffness.value_or (m.stiffness), .damping = c.damping.value_or (m.damping), .period_s = period_s };
    const std::array<const DeviceNumbers*, 3> axes { &numbers, &numbers, &numbers };
    constexpr std::array<double, 3> whole { 1.0, 1.0, 1.0 };
    const auto response = varies ? sum (sum (m.rest, s.stiffness, m.spring), s.damping, m.damper) : asIs (rate_hz, c.params).response;
    s.load = check::passivityLoad (response, axes, whole, period_s).value_or (std::nan (""));
    s.largest_damper = check::largestDamper (numbers, period_s);
    const bool is_smooth = numbers.quantum && numbers.quantum->value <= 0.0;
    s.stiffest_held = is_smooth                            ? std::numeric_limits<double>::infinity()
                      : numbers.quantum && numbers.coulomb ? 2.0 * numbers.coulomb->value / numbers.quantum->value
                                                           : std::numeric_limits<double>::quiet_NaN();
    s.quietest_damper = 0.5 * s.stiffest_held * period_s;
    if (period_s <= (1.0 + 1e-9) / rate_hz) s.radius = check::largestRadius (response, axes, period_s);
    return s;
}

}   // namespace tactus::host
