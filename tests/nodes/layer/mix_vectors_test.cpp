// SPDX-License-Identifier: MIT
#include <tactus/nodes/layer/mix.hpp>
#include <tactus/nodes/layer/mix_vectors.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <vector>

using tactus::DeskParams;
using tactus::Vec3;
using tactus::nodes::LayerMix;
using tactus::nodes::LayerMixVectors;

namespace
{
/// A desk with wired layers: of numbers, or of vectors.
template <typename Node, typename Layer>
class WiredDesk
{
public:
    explicit WiredDesk (int inputs, const DeskParams& params = {})
    {
        node.settings.inputs = inputs;
        node.prepare ({ .rate_hz = 1000.0 });
        change (params);
    }

    void change (const DeskParams& params)
    {
        node.params = params;
        node.update();
    }

    typename Node::Outputs mix (const std::vector<Layer>& layers)
    {
        std::vector<const double*> sources;
        for (const auto& v : layers)
            if constexpr (std::is_same_v<Layer, Vec3>)
                sources.insert (sources.end(), { v.data(), v.data() + 1, v.data() + 2 });
            else
                sources.push_back (&v);
        return node.tick ({ .in = { sources.data(), static_cast<int> (layers.size()) } });
    }

    Node node;
};

using NumberDesk = WiredDesk<LayerMix, double>;
using VectorDesk = WiredDesk<LayerMixVectors, Vec3>;

/// A random number with two digits after the point.
double anyNumber (int most) { return 0.01 * *rc::gen::inRange (-100 * most, 100 * most); }

Vec3 anyVector (int most)
{
    const double x = anyNumber (most), y = anyNumber (most), z = anyNumber (most);
    return { x, y, z };
}

DeskParams anyParams (int layers)
{
    DeskParams p;
    for (int i = 0; i < layers; ++i)
    {
        p.gain[i] = anyNumber (2);
        p.mute[i] = *rc::gen::element (0.0, 0.0, 1.0);
        p.solo[i] = *rc::gen::element (0.0, 0.0, 0.0, 1.0);
        p.priority[i] = *rc::gen::inRange (0, 3);
    }
    p.ceiling = *rc::gen::element (0.0, 2.0);
    return p;
}
}   // namespace

TEST_CASE ("layer vectors: by default the layers are added, each with its own gain", "[nodes][layer]")
{
    DeskParams p;
    p.gain[1] = 0.5;
    VectorDesk desk { 2, p };
    const auto out = desk.mix ({ { 1.0, 2.0, -3.0 }, { 10.0, 0.0, 4.0 } });
    CHECK (out.out == Vec3 (6.0, 2.0, -1.0));
    CHECK (out.level[0] == Approx (std::sqrt (14.0)));
    CHECK (out.level[1] == Approx (0.5 * std::sqrt (116.0)));
    CHECK (out.reduction == 0.0);
}

TEST_CASE ("layer vectors: layers along one axis are mixed as layer.mix mixes numbers, except for the last bits at the ceiling", "[nodes][layer]")
{
    tactus::test::property ("any axis, params and layers", [] {
        const int axis = *rc::gen::inRange (0, 3);
        NumberDesk numbers { 3, anyParams (3) };
        VectorDesk vectors { 3, numbers.node.params };
        for (int k = 0; k < 60; ++k)
        {
            if (k == 30)
            {
                numbers.change (anyParams (3));
                vectors.change (numbers.node.params);
            }
            std::vector<double> layers (3);
            std::vector<Vec3> along (3, Vec3::Zero());
            for (int i = 0; i < 3; ++i)
                along[tactus::at (i)][axis] = layers[tactus::at (i)] = anyNumber (3);
            const auto number = numbers.mix (layers);
            const auto vector = vectors.mix (along);
            if (number.reduction == 0.0)
                RC_ASSERT (vector.out[axis] == number.out);
            else
                RC_ASSERT (std::abs (vector.out[axis] - number.out) <= 1e-12);
            RC_ASSERT (vector.out[(axis + 1) % 3] == 0.0);
            for (int i = 0; i < 3; ++i)
                RC_ASSERT (std::abs (vector.level[i] - number.level[i]) <= 1e-12 * number.level[i]);
        }
    });
}

TEST_CASE ("layer vectors: a layer keeps its direction through gain, mute, solo and ceiling", "[nodes][layer]")
{
    tactus::test::property ("the mix of one layer is parallel to it", [] {
        auto p = anyParams (1);
        p.gain[0] = std::abs (p.gain[0]);
        VectorDesk desk { 1, p };
        const Vec3 layer = anyVector (10);
        for (int k = 0; k < 20; ++k)
        {
            if (k == 5) p.mute[0] = 1.0 - p.mute[0];
            desk.change (p);
            const Vec3 out = desk.mix ({ layer }).out;
            RC_ASSERT (out.cross (layer).norm() <= 1e-12 * layer.squaredNorm());
            RC_ASSERT (out.dot (layer) >= 0.0);
        }
    });
}

TEST_CASE ("layer vectors: the mix is never longer than the ceiling, and below it nothing changes", "[nodes][layer]")
{
    tactus::test::property ("any layers", [] {
        DeskParams p;
        p.ceiling = *rc::gen::element (1e-3, 2.0, 20.0);
        VectorDesk desk { 2, p }, open { 2 };
        for (int k = 0; k < 20; ++k)
        {
            const Vec3 a = anyVector (10), b = anyVector (10);
            const auto out = desk.mix ({ a, b });
            const Vec3 sum = open.mix ({ a, b }).out;
            RC_ASSERT (tactus::length (out.out) <= p.ceiling);
            if (tactus::length (sum) <= p.ceiling)
                RC_ASSERT (out.out == sum);
            else
                RC_ASSERT ((out.out / p.ceiling - sum.normalized()).norm() <= 1e-12);
            RC_ASSERT ((out.reduction > 0.0) == (out.out != sum));
        }
    });
}

TEST_CASE ("layer vectors: one bad component silences everything, and the next sample counts as the first", "[nodes][layer]")
{
    constexpr double inf = tactus::inf, not_a_number = std::numeric_limits<double>::quiet_NaN(), huge = 1.7e308;
    const std::vector<std::vector<Vec3>> faults {
        { { inf, 0.0, 0.0 }, { 1.0, 0.0, 0.0 } },    // a layer that is not finite
        { { 0.0, inf, -inf }, { 1.0, 0.0, 0.0 } },   // whose components cancel
        { { 0.0, 0.0, not_a_number }, { 1.0, 0.0, 0.0 } },
        { { 0.0, huge, 0.0 }, { 0.0, huge, 0.0 } },    // a sum that overflows in one component
        { { huge, huge, huge }, { 0.0, 0.0, 0.0 } },   // a length that overflows
    };
    for (const auto& fault : faults)
    {
        VectorDesk desk { 2 };
        desk.mix ({ { 1.0, 1.0, 1.0 }, { 1.0, 1.0, 1.0 } });
        const auto out = desk.mix (fault);
        CHECK (out.out == Vec3 (0.0, 0.0, 0.0));
        CHECK (out.level[0] == 0.0);
        CHECK (out.level[1] == 0.0);
        CHECK (out.reduction == 0.0);
        DeskParams muted;
        muted.mute[0] = 1.0;
        desk.change (muted);
        CHECK (desk.mix ({ { 1.0, 0.0, 0.0 }, { 0.0, 2.0, 0.0 } }).out == Vec3 (0.0, 2.0, 0.0));   // muted without a ramp
    }
}

/// How much longer than a ceiling that is a denormal number a mix may be. Rounding each component to a multiple of the smallest number
/// adds up to sqrt (3)/2 of it to the length, and rounding the length half of it.
constexpr double denormal_rounding = 2.0 * std::numeric_limits<double>::denorm_min();

TEST_CASE ("layer vectors: a ceiling that is a denormal number holds but for the last bit", "[nodes][layer]")
{
    DeskParams params;
    params.ceiling = 1e-320;
    double most = 0.0;
    for (const double y : { 0.0, 1.0, -1e160, 1e300, -1.7e308 })
        for (const double z : { 0.0, 1.0, -1e160, 1e300, -1.7e308 })
        {
            VectorDesk desk { 1, params };
            most = std::max (most, tactus::length (desk.mix ({ Vec3 { -1e160, y, z } }).out) - 1e-320);
        }
    CHECK (most > 0.0);
    CHECK (most <= denormal_rounding);
}

TEST_CASE ("layer vectors: no input breaks it", "[nodes][layer]")
{
    tactus::test::property ("outputs are finite", [] {
        const auto number = rc::gen::element (0.0, 1.0, -1.0, 1e-320, -1e160, 1e300, -1.7e308, 1.7e308, std::nan (""), tactus::inf);
        const auto param = rc::gen::element (0.0, 1.0, -2.0, 1e300);
        DeskParams p;
        for (int i = 0; i < 2; ++i)
        {
            p.gain[i] = *param;
            p.priority[i] = *param;
            p.mute[i] = *rc::gen::element (0.0, 1.0);
        }
        p.duck_db = *rc::gen::element (0.0, 12.0, 1e300);
        p.ceiling = *rc::gen::element (0.0, 1e-320, 1.0, 1e300);
        VectorDesk desk { 2, p };
        for (int k = 0; k < 20; ++k)
        {
            std::vector<Vec3> layers (2);
            for (auto& layer : layers)
                for (int axis = 0; axis < 3; ++axis)
                    layer[axis] = *number;
            const auto out = desk.mix (layers);
            RC_ASSERT (tactus::isFinite (out.out, out.reduction, out.level[0], out.level[1]));
            RC_ASSERT (p.ceiling == 0.0 || tactus::length (out.out) <= p.ceiling + denormal_rounding);
        }
    });
}
