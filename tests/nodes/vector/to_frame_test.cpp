// SPDX-License-Identifier: MIT
#include <tactus/nodes/vector/from_frame.hpp>
#include <tactus/nodes/vector/to_frame.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

namespace
{
tactus::Vec3 anyVector()
{
    const auto part = rc::gen::map (rc::gen::arbitrary<int>(), [] (int i) { return i / 1e5; });
    return { *part, *part, *part };
}
}   // namespace

TEST_CASE ("to frame: undoes from frame", "[nodes][vector]")
{
    tactus::test::property ("any frame, any point", [] {
        tactus::nodes::VectorFromFrame from;
        tactus::nodes::VectorToFrame to;
        from.params.origin = to.params.origin = anyVector();
        from.params.rotation = to.params.rotation = anyVector() * 1e-4;
        from.update();
        to.update();
        const auto in = anyVector();
        const auto out = to.tick ({ .in = from.tick ({ .in = in }).out }).out;
        RC_ASSERT ((out - in).norm() <= 1e-13 * (in.norm() + from.params.origin.norm()));
    });
}
