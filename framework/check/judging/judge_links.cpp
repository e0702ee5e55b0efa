// SPDX-License-Identifier: MIT
#include "judging.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <limits>
#include <optional>

namespace tactus::check::judging
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Roles whose forces depend on each other's positions, or a single role.
class Group
{
public:
    Group (const Demand& d, std::span<const RoleDevice> devices, const JudgeOptions& o, std::vector<std::size_t> its_roles)
        : demand (d), options (o), members (std::move (its_roles))
    {
        for (const auto r : members)
        {
            numbers.push_back (numbersFor (devices, d.roles[r]));
        }
    }

    void judge (std::vector<Condition>& all) const
    {
        if (members.size() > 1) coupling (all);
        curl (all);
    }

private:
    const Demand& demand;
    const JudgeOptions& options;
    std::vector<std::size_t> members;
    std::vector<DeviceNumbers> numbers {};   // of the members

    Index size() const noexcept { return static_cast<Index> (3 * members.size()); }
    const std::string& nameOf (std::size_t member) const { return demand.roles[members[member]].role; }
    bool canAllTick (double rate_hz) const
    {
        return std::ranges::all_of (numbers, [&] (const DeviceNumbers& n) { return reaches (n, rate_hz) && ! isSlow (demand, n); });
    }

    bool know (DeviceNumbers::Number DeviceNumbers::*n) const
    {
        return std::ranges::all_of (numbers, [&] (const DeviceNumbers& d) { return (d.*n).has_value(); });
    }

    /// The rows and columns of a matrix of all roles that belong to the members.
    MatrixXd of (const MatrixXd& all) const
    {
        MatrixXd part (size(), size());
        const auto at = [] (std::size_t hand) { return static_cast<Index> (3 * hand); };
        for (std::size_t i = 0; i < members.size(); ++i)
            for (std::size_t j = 0; j < members.size(); ++j)
                part.block<3, 3> (at (i), at (j)) = all.block<3, 3> (at (members[i]), at (members[j]));
        return part;
    }

    /// A number of each member's device, repeated for its three axes.
    template <typename F>
    VectorXd perAxis (F&& number) const
    {
        VectorXd v (size());
        for (std::size_t i = 0; i < members.size(); ++i)
            v.segment<3> (static_cast<Index> (3 * i)).setConstant (number (numbers[i]));
        return v;
    }

    std::size_t largestMember (const VectorXd& v) const
    {
        std::size_t most = 0;
        for (std::size_t i = 1; i < members.size(); ++i)
            if (v.segment<3> (static_cast<Index> (3 * i)).norm() > v.segment<3> (static_cast<Index> (3 * most)).norm()) most = i;
        return most;
    }

    static double norm (const MatrixXd& m)
    {
        const MatrixXd square = m.transpose() * m;
        return std::sqrt (std::max (0.0, Eigen::SelfAdjointEigenSolver<MatrixXd> (square).eigenvalues().maxCoeff()));
    }

    /// If K is symmetric, a sampled loop f = -K p with a hold is passive if B - T (d + 1/2) K is positive definite: for every movement of
    /// all hands, the devices then dissipate more than the hold returns. In other words, no eigenvalue of B^-1/2 T (d + 1/2) K B^-1/2
    /// exceeds 1. For a single axis, this is the condition `stiffness`.
    void coupling (std::vector<Condition>& all) const
    {
        const auto together = "the hands " + names() + " together";
        auto& c = all.emplace_back (Condition {
            .id = "coupling", .role = nameOf (0), .law = "|(2d + 1) T K/2 + L|, each over B, <= 1", .unit = "1", .text = together });
        if (! know (&DeviceNumbers::damping)) return unknown (c, 0.0, "damping");
        static constexpr double least = 1e-9;   // N s/m; used in place of a damping of 0
        const VectorXd over = perAxis ([] (const DeviceNumbers& n) { return 1.0 / std::sqrt (std::max (+least, n.damping->value)); });
        const VectorXd hold = perAxis ([&] (const DeviceNumbers& n) { return (0.5 + delayOf (n)) * periodOf (demand, n); });
        double most = 0.0, most_excess = 0.0;
        const Linked* at = nullptr;
        std::size_t member = 0;
        std::vector<double> loads;
        for (const auto& place : demand.linked)
        {
            const MatrixXd k = over.asDiagonal() * MatrixXd (hold.asDiagonal() * of (place.settled)) * over.asDiagonal();
            const MatrixXd symmetric = 0.5 * (k + k.transpose());
            const Eigen::SelfAdjointEigenSolver<MatrixXd> parts (symmetric);
            Index worst = 0;
            const double held = parts.eigenvalues().cwiseAbs().maxCoeff (&worst);
            const auto scaled = [&] (const MatrixXd& m) { return norm (over.asDiagonal() * of (m) * over.asDiagonal()); };
            const double excess = scaled (place.excess), load = held + scaled (place.late) + excess;
            most_excess = std::max (most_excess, excess);
            loads.push_back (load);
            if (at != nullptr && load <= most) continue;
            most = load;
            at = &place;
            member = largestMember (parts.eigenvectors().col (worst));
        }
        c.role = nameOf (member);
        c.text += " at " + text (at->t_s, "s");
        std::vector<std::string> ways { "all stiffnesses and dampings " + text (roundedBound (1.0 / most, false), "times") + " as large" };
        // A damper does not become weaker at a higher rate.
        if (const double room = 1.0 - most_excess, times = (most - most_excess) / room; room > 0.0 && canAllTick (times * demand.rate_hz))
            ways.push_back ("a rate " + text (roundedBound (times, true), "times") + " as high");
        ways.push_back ("devices with " + text (roundedBound (most, true), "times") + " the damping");
        auto remedy = anyOf (ways);
        if (const auto node = steepestNode (demand, at->by_node); ! node.empty()) remedy += "; the steepest node is " + node;
        decideContact (c, most, 1.0, remedy);
        std::vector<const RoleDemand*> its;
        for (const auto m : members)
            its.push_back (&demand.roles[m]);
        constexpr double precision = 2e-3;
        const bool turns = std::ranges::any_of (demand.linked, [&] (const Linked& l) { return l.is_smooth && turnOf (of (l.settled)) > precision; });
        if (turns) std::ranges::fill (loads, inf);   // no slope shows whether hands with unequal damping swing, if each pulls the other with another force
        if (c.verdict == Verdict::broken || turns) closeLoop (c, loads);
        if (turns && c.verdict == Verdict::passive)   // closeLoop() does not know the loop
        {
            const auto grows = [this] (const Linked& l) { return l.is_smooth && growsSlowly (l); };
            const bool swings = know (&DeviceNumbers::mass) && std::ranges::any_of (demand.linked, grows);
            c.verdict = swings ? Verdict::unstable : Verdict::unknown;
            c.remedy = "forces between the hands that pull each as much as the other, or sections that all run on every tick";
            if (swings)
            {
                c.may_grow = std::numeric_limits<double>::quiet_NaN();
                c.text += "; to first order in the time by which the forces come late, the hands swing ever more";
            }
        }
        weigh (demand, options.trials, c, its, turns, false);
    }

    /// True if M p'' + (B - T (d + 1/2) K - L) p' + K p = 0 swings ever more, with the masses and dampings of all members. It leaves out what is of second
    /// order in the time by which the forces come late, so it is right only for a swing that is slow beside that.
    bool growsSlowly (const Linked& place) const
    {
        if (of (place.excess).norm() > 0.0) return false;   // of a damper, whose sign is not known
        const VectorXd per_mass = perAxis ([] (const DeviceNumbers& n) { return 1.0 / n.mass->value; });
        const VectorXd damping = perAxis ([] (const DeviceNumbers& n) { return n.damping->value; });
        const VectorXd hold = perAxis ([&] (const DeviceNumbers& n) { return (0.5 + delayOf (n)) * periodOf (demand, n); });
        const MatrixXd k = of (place.settled);
        MatrixXd motion = MatrixXd::Zero (2 * size(), 2 * size());
        motion.topRightCorner (size(), size()).setIdentity();
        motion.bottomLeftCorner (size(), size()) = -(per_mass.asDiagonal() * k);
        motion.bottomRightCorner (size(), size()) = per_mass.asDiagonal() * (hold.asDiagonal() * k + of (place.late) - MatrixXd (damping.asDiagonal()));
        constexpr double precision = 2e-3;   // of the slopes
        const Eigen::VectorXcd all = motion.eigenvalues();
        return std::ranges::any_of (all, [] (const auto& z) { return z.imag() > 0.0 && z.real() > precision * std::abs (z); });
    }

    /// Judges the loops of all hands together at the places whose load is above 1, exactly.
    void closeLoop (Condition& c, std::span<const double> loads) const
    {
        if (! know (&DeviceNumbers::mass)) return noLoop (c);
        std::vector<const DeviceNumbers*> axes;
        for (const auto& n : numbers)
        {
            if (isSlow (demand, n)) return noLoop (c);
            axes.insert (axes.end(), 3, &n);
        }
        std::vector<std::vector<Jacobian>> responses;
        for (std::size_t i = 0; i < loads.size(); ++i)
        {
            if (loads[i] <= 1.0) continue;
            if (demand.linked[i].responses.empty()) return noLoop (c);
            std::vector<Jacobian> response;
            for (const auto& m : demand.linked[i].responses)
                response.emplace_back (of (m));
            if (std::ranges::none_of (responses, [&] (const auto& known) { return isLike (known, response); })) responses.push_back (std::move (response));
        }
        const double period_s = 1.0 / demand.rate_hz;
        std::vector<const std::vector<Jacobian>*> places;
        for (const auto& r : responses)
            places.push_back (&r);
        closeLoops (
            c, places, [&] (const auto* r) { return largestRadius (*r, axes, period_s); },
            [&] (const auto* r, double factor) {
                auto larger = *r;
                for (auto& m : larger)
                    m *= factor;
                return comesToRest (larger, axes, period_s);
            },
            [] (const auto*) { return false; });
    }

    std::string names() const
    {
        std::string text;
        for (std::size_t i = 0; i < members.size(); ++i)
            text += (i == 0 ? "'" : i + 1 == members.size() ? " and '"
                                                            : ", '")
                    + nameOf (i) + "'";
        return text;
    }

    /// An eigenvalue k + j n of the Jacobian at a place, and the largest n that the device allows; all in N/m. n turns the tool.
    struct Turn
    {
        double n = 0.0, limit = 0.0;
        double k = 0.0;
        std::size_t member = 0;
        const Linked* at = nullptr;

        bool isWorseThan (const Turn& other) const noexcept { return n * other.limit > other.n * limit || (limit == 0.0 && other.limit > 0.0); }
    };

    /// M p'' + B p' + (k + j n) p = 0, where k + j n is an eigenvalue of the Jacobian, is stable if and only if n^2 M < B^2 k (Routh and
    /// Hurwitz for complex coefficients). If the force comes late by tau, B is reduced by k tau, and the condition is n^2 (M + B tau) < B^2 k.
    std::optional<Turn> turnAt (const Linked& place) const
    {
        const auto massOf = [] (const DeviceNumbers& n) { return n.mass->value; };
        const VectorXd over = perAxis ([&] (const DeviceNumbers& n) { return 1.0 / std::sqrt (massOf (n)); });
        const MatrixXd settled = of (place.settled), k = over.asDiagonal() * settled * over.asDiagonal();
        const Eigen::EigenSolver<MatrixXd> parts (k);
        const Eigen::MatrixXcd vectors = parts.eigenvectors(), inverse = vectors.inverse();
        double tau = 0.0, loss = std::numeric_limits<double>::infinity();   // s, 1/s
        for (const auto& n : numbers)
        {
            tau = std::max (tau, (0.5 + delayOf (n)) * periodOf (demand, n));
            loss = std::min (loss, n.damping->value / massOf (n));
        }
        if (const double stiffness = settled.norm(); stiffness > 0.0) tau += of (place.late).norm() / stiffness;

        std::optional<Turn> worst;
        for (Index i = 0; i < size(); ++i)
        {
            const std::complex<double> value = parts.eigenvalues()[i];
            constexpr double precision = 1e-3;   // of a measured slope; an eigenvalue of nearly parallel eigenvectors is less precise
            const double error = precision * k.norm() * inverse.row (i).norm() * vectors.col (i).norm();
            if (! (value.imag() > error)) continue;
            const auto member = largestMember (vectors.col (i).cwiseAbs());
            const double mass = massOf (numbers[member]), left = std::max (0.0, loss - value.real() * tau);
            const double limit = value.real() > 0.0 ? left * std::sqrt (value.real() / (1.0 + left * tau)) : 0.0;
            const Turn turn { .n = mass * value.imag(), .limit = mass * limit, .k = mass * value.real(), .member = member, .at = &place };
            if (! worst || turn.isWorseThan (*worst)) worst = turn;
        }
        return worst;
    }

    void curl (std::vector<Condition>& all) const
    {
        const bool is_known = know (&DeviceNumbers::damping) && know (&DeviceNumbers::mass);
        if (! is_known) return curlUnknown (all);
        std::optional<Turn> worst;
        for (const auto& place : demand.linked)
            if (place.is_smooth)
                if (const auto turn = turnAt (place); turn && (! worst || turn->isWorseThan (*worst))) worst = turn;
        if (! worst) return;
        auto& c = all.emplace_back (Condition { .id = "curl", .role = nameOf (worst->member), .law = "n <= B sqrt(k/M)", .unit = "N/m" });
        c.text = "the force at " + text (worst->at->t_s, "s") + " pulls back with k " + text (worst->k, "N/m") + " and turns the tool with n "
                 + text (worst->n, "N/m");
        auto remedy = worst->limit > 0.0 ? "a field that turns with at most " + text (worst->limit, "N/m") + ", or a device with more damping"
                                         : std::string ("a field that is the gradient of an energy: nothing pulls this one back");
        if (const auto node = steepestNode (demand, worst->at->by_node); ! node.empty()) remedy += "; the steepest node is " + node;
        decide (c, worst->n, worst->limit, Strict::no, 1.0, remedy);
    }

    void curlUnknown (std::vector<Condition>& all) const
    {
        double most = 0.0;
        for (const auto& place : demand.linked)
            if (const MatrixXd k = of (place.settled); place.is_smooth && k.size() > 0)
                for (const auto value : k.eigenvalues())
                    if (value.imag() > 1e-2 * k.norm()) most = std::max (most, value.imag());
        if (! (most > 0.0)) return;
        auto& c = all.emplace_back (Condition { .id = "curl", .role = nameOf (0), .law = "n <= B sqrt(k/M)", .unit = "N/m" });
        c.text = "the force turns the tool with n " + text (most, "N/m");
        unknown (c, most, "mass or damping");
    }
};

/// True if, at any place, the force of one role depends on the position of the other.
bool areLinked (const Demand& demand, std::size_t a, std::size_t b)
{
    constexpr double least = 1e-6;   // relative to the whole matrix
    return std::ranges::any_of (demand.linked, [&] (const Linked& place) {
        const auto reaches = [&] (const MatrixXd& m, std::size_t i, std::size_t j) {
            return m.block<3, 3> (static_cast<Index> (3 * i), static_cast<Index> (3 * j)).norm() > least * m.norm();
        };
        const auto either = [&] (const MatrixXd& m) { return reaches (m, a, b) || reaches (m, b, a); };
        return either (place.settled) || either (place.late) || either (place.excess);
    });
}
}   // namespace

void judgeLinks (const Demand& demand, std::span<const RoleDevice> devices, const JudgeOptions& options, std::vector<Condition>& all)
{
    if (demand.linked.empty()) return;
    std::vector<bool> done (demand.roles.size(), false);
    for (std::size_t r = 0; r < done.size(); ++r)
    {
        if (done[r]) continue;
        done[r] = true;
        std::vector<std::size_t> group { r };
        for (std::size_t i = 0; i < group.size(); ++i)
            for (std::size_t other = 0; other < done.size(); ++other)
                if (! done[other] && areLinked (demand, group[i], other))
                {
                    done[other] = true;
                    group.push_back (other);
                }
        Group (demand, devices, options, std::move (group)).judge (all);
    }
}

}   // namespace tactus::check::judging
