// SPDX-License-Identifier: MIT
#include "node_loops.hpp"
#include "sampled_loop.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace tactus::check
{

namespace
{
std::vector<double> along (const Eigen::Vector3d& d, std::span<const Jacobian> response)
{
    std::vector<double> all;
    for (const auto& m : response)
        all.push_back (d.dot (Eigen::Matrix3d (m) * d));
    return all;
}

double passiveUpTo (const std::vector<double>& response, const DeviceNumbers& device, double period_s)
{
    std::vector<Jacobian> one;
    for (const double v : response)
        one.push_back (Jacobian::Constant (1, 1, v));
    const std::array<const DeviceNumbers*, 1> axis { &device };
    const double load = passivityLoad (one, axis, std::array { 1.0 }, period_s).value_or (0.0);
    return load > 0.0 ? device.damping->value / load : std::numeric_limits<double>::infinity();
}

NodeLoop loopOf (std::size_t node, std::vector<double> response, const DeviceNumbers& device, double period_s)
{
    NodeLoop loop { .node = node, .response = std::move (response) };
    loop.passive_up_to = passiveUpTo (loop.response, device, period_s);
    loop.may_grow = roomToGrow ([&] (double factor) {
        auto larger = loop.response;
        for (double& v : larger)
            v *= factor;
        return comesToRest (larger, device, period_s);
    });
    return loop;
}
}   // namespace

std::vector<NodeLoop> nodeLoops (const Slope& slope, std::span<const Jacobian> response, const DeviceNumbers& device, double period_s)
{
    constexpr double faint = 1e-2, parallel = 0.9;   // of the steepest response; cosine
    std::vector<NodeLoop> all;
    if (! device.mass || ! device.damping || response.empty()) return all;
    std::vector<std::size_t> nodes (slope.gradients.size());
    std::iota (nodes.begin(), nodes.end(), std::size_t { 0 });
    std::ranges::stable_sort (nodes, std::ranges::greater {}, [&] (std::size_t n) { return slope.by_node[n]; });
    std::vector<Eigen::Vector3d> taken;
    for (const auto n : nodes)
    {
        if (! (slope.by_node[n] > faint * slope.by_node[nodes.front()])) break;
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts (slope.gradients[n]);
        std::optional<NodeLoop> weakest;
        for (int i = 2; i >= 0 && parts.eigenvalues()[i] > faint * parts.eigenvalues()[2]; --i)
        {
            const Eigen::Vector3d d = parts.eigenvectors().col (i);
            if (std::ranges::any_of (taken, [&] (const auto& t) { return std::abs (t.dot (d)) > parallel; })) continue;
            taken.push_back (d);
            if (auto loop = loopOf (n, along (d, response), device, period_s); ! weakest || loop.may_grow < weakest->may_grow) weakest = std::move (loop);
        }
        if (weakest) all.push_back (*std::move (weakest));
    }
    std::ranges::stable_sort (all, {}, &NodeLoop::may_grow);
    return all;
}

}   // namespace tactus::check
