// SPDX-License-Identifier: MIT
#include "textures.hpp"
#include "side_by_side.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <memory>
#include <numbers>
#include <numeric>
#include <set>

namespace tactus::check
{

namespace
{
constexpr double felt_part = 0.1;   // a texture is felt while its force is at least this fraction of its largest force

/// Removes from a velocity the directions in which a node does not feel a displacement. `directions`: see slopes.hpp.
class Across
{
public:
    explicit Across (const Eigen::Matrix3d& directions) : parts (directions) {}

    Vec3 operator() (const Vec3& velocity) const
    {
        const double most = parts.eigenvalues()[2];
        if (! (most > 0.0)) return velocity;
        Vec3 kept = Vec3::Zero();
        for (int i = 0; i < 3; ++i)
            if (parts.eigenvalues()[i] > 1e-3 * most) kept += parts.eigenvectors().col (i).dot (velocity) * parts.eigenvectors().col (i);
        return kept;
    }

private:
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts;
};
}   // namespace

double Textures::Watched::ownAmplitude() const noexcept { return claims.amplitude < inf ? std::max (loudest, claims.amplitude) : loudest; }

double Textures::Watched::ownSlope (double amplitude) const noexcept
{
    return claims.stiffness > 0.0 && claims.stiffness < inf ? claims.stiffness : 2.0 * std::numbers::pi * amplitude * claims.spatial_frequency;
}

void Textures::Watched::poll (const Plan& plan, bool with_claims)
{
    loudest = std::max (loudest, forces.largest());
    if (! with_claims) return;
    const auto now = plan.flat().nodes[node].type->claims (plan.instances()[node].node.get());
    claims.spatial_frequency = std::max (claims.spatial_frequency, now.spatial_frequency);
    claims.stiffness = std::max (claims.stiffness, now.stiffness);
    claims.amplitude = claims.amplitude == inf ? now.amplitude : std::max (claims.amplitude, now.amplitude);
}

void Textures::find (const Plan& plan)
{
    for (std::size_t n = 0; n < plan.flat().nodes.size(); ++n)
    {
        const auto& node = plan.flat().nodes[n];
        const auto& instance = plan.instances()[n];
        if (! node.runs() || node.type->claims == nullptr || ! (node.type->claims (instance.node.get()).spatial_frequency > 0.0)) continue;
        watched.push_back ({ n, NodeForces (plan, n), std::ranges::count (instance.driven, true) > 0 });
        watched.back().poll (plan, true);
    }
}

void Textures::poll (const Plan& plan, std::size_t ticks)
{
    for (auto& w : watched)
        w.poll (plan, w.is_driven && ticks % 16 == 0);
}

std::vector<std::size_t> Textures::nodes() const
{
    std::vector<std::size_t> all;
    for (const auto& w : watched)
        all.push_back (w.node);
    return all;
}

class Textures::Adding
{
public:
    Adding (const std::vector<Watched>& all, const RunAlong& r, Demand& d) : textures (all), run (r), demand (d) {}

    void add (const Thoroughness& how)
    {
        const auto runs = std::max<std::size_t> (1, how.ticks / 4 / std::max<std::size_t> (1, run.motion.ticks));
        const auto alone = steepest (runs < textures.size() ? runs - 1 : textures.size());
        const auto others = alone.size() < textures.size() ? ownSpeeds() : std::vector<std::vector<double>>();
        std::vector<std::unique_ptr<Bench>> benches;
        for (const auto t : alone)
        {
            benches.push_back (std::make_unique<Bench> (run.subject, run.motion));
            benches.back()->silence ({ textures[t].node });
        }
        std::vector<Forces> without (benches.size());
        sideBySide (benches.size(), how.threads, [&] (std::size_t i) { without[i] = forcesAlong (*benches[i], run.motion, [] (const Plan&) {}); });
        auto its = without.begin();
        for (std::size_t t = 0; t < textures.size(); ++t)
            alone.contains (t) ? addTexture (textures[t], *its++) : addOther (textures[t], others[t]);
    }

private:
    const std::vector<Watched>& textures;
    const RunAlong& run;
    Demand& demand;

    /// The indices of so many textures, the steepest ones.
    std::set<std::size_t> steepest (std::size_t count) const
    {
        const auto slope = [&] (std::size_t t) { return textures[t].ownSlope (textures[t].ownAmplitude()); };
        std::vector<std::size_t> all (textures.size());
        std::iota (all.begin(), all.end(), std::size_t { 0 });
        if (count < all.size()) std::ranges::stable_sort (all, std::ranges::greater {}, slope);
        return { all.begin(), all.begin() + static_cast<std::ptrdiff_t> (count) };
    }

    Across acrossOf (std::size_t role, std::size_t node) const
    {
        const auto& ways = run.directions[role];
        return Across { node < ways.size() ? ways[node] : Eigen::Matrix3d (Eigen::Matrix3d::Zero()) };
    }

    /// By texture, then role: the largest speed across the texture while it gives at least felt_part of its largest force, in m/s.
    std::vector<std::vector<double>> ownSpeeds() const
    {
        const auto roles = run.motion.roles.size();
        std::vector<std::vector<double>> speeds (textures.size(), std::vector<double> (roles, 0.0));
        std::vector<Across> across;
        for (const auto& t : textures)
            for (std::size_t r = 0; r < roles; ++r)
                across.push_back (acrossOf (r, t.node));
        std::vector<NodeForces> own;
        std::size_t k = 0;
        forcesAlong (run.subject, run.motion, {}, [&] (const Plan& running) {
            for (std::size_t t = 0; t < textures.size(); ++t)
            {
                if (k == 0) own.emplace_back (running, textures[t].node);
                const double now = own[t].largest();
                for (std::size_t r = 0; r < roles && now > 0.0 && now >= felt_part * textures[t].loudest; ++r)
                    speeds[t][r] = std::max (speeds[t][r], across[t * roles + r](run.velocities[r][k]).norm());
            }
            ++k;
        });
        return speeds;
    }

    /// A texture that has no run of its own. The roles behind it are taken to feel the force that it has.
    void addOther (const Watched& watched, const std::vector<double>& speeds)
    {
        for (std::size_t r = 0; r < run.motion.roles.size(); ++r)
        {
            if (! run.between[r][watched.node] || run.motion.roles[r].axis) continue;
            const auto& role = run.motion.roles[r].role;
            const double amplitude = watched.ownAmplitude();
            if (watched.loudest > 0.0)
                demand.textures.push_back ({ watched.node, role, watched.claims.spatial_frequency, amplitude, watched.ownSlope (amplitude), speeds[r] });
            else
                demand.unreached.push_back ({ watched.node, role, true });
        }
    }

    /// `without`: the forces of the graph without this texture.
    void addTexture (const Watched& watched, const Forces& without)
    {
        for (std::size_t r = 0; r < run.motion.roles.size(); ++r)
            if (! run.motion.roles[r].axis) addTexture (watched, r, without[r]);
    }

    void addTexture (const Watched& watched, std::size_t r, const std::vector<Vec3>& without)
    {
        const auto part = [&] (std::size_t k) { return (run.forces[r][k] - without[k]).norm(); };
        double most = 0.0;
        for (std::size_t k = 0; k < run.motion.ticks; ++k)
            most = std::max (most, part (k));
        const auto& [node, own, is_driven, claims, loudest] = watched;
        if (! (most > 0.0))
        {
            if (run.between[r][node]) demand.unreached.push_back ({ node, run.motion.roles[r].role, true });
            return;
        }
        Texture t { .node = node, .role = run.motion.roles[r].role, .spatial_frequency = claims.spatial_frequency };
        const double reach = loudest > 0.0 ? most / loudest : 1.0;   // gain of the wires and layers that follow the node
        t.amplitude = claims.amplitude < inf ? std::max (most, reach * claims.amplitude) : most;
        t.slope = claims.stiffness > 0.0 && claims.stiffness < inf ? reach * claims.stiffness : 2.0 * std::numbers::pi * t.amplitude * t.spatial_frequency;
        const auto across = acrossOf (r, node);
        for (std::size_t k = 0; k < run.motion.ticks; ++k)
            if (part (k) >= felt_part * most) t.speed = std::max (t.speed, across (run.velocities[r][k]).norm());
        demand.textures.push_back (std::move (t));
    }
};

void Textures::addTo (Demand& demand, const RunAlong& run, const Thoroughness& how) const { Adding (watched, run, demand).add (how); }

}   // namespace tactus::check
