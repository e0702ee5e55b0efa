// SPDX-License-Identifier: MIT
// Compiled for both libraries: SIDE is the namespace of this one.
#ifdef WITH_TACTUS
#include <tactus/node/catalogue.hpp>
#include <tactus/run/run.hpp>
#endif
#include "body.hpp"

Layout SIDE::layout()
{
    using namespace Eigen;
    Layout all { sizeof (Body), alignof (Body), offsetof (Body, wheel_loads), offsetof (Body, attitude), offsetof (Body, place), offsetof (Body, drag) };
    for (const auto n : { alignof (Vector2d), alignof (Vector3d), alignof (Vector4d), alignof (Matrix3d), alignof (Matrix4d), alignof (Quaterniond),
                          alignof (Isometry3d), alignof (Vector4f), std::size_t { EIGEN_MAX_ALIGN_BYTES }, std::size_t { EIGEN_MAX_STATIC_ALIGN_BYTES } })
        all.push_back (n);
#ifdef EIGEN_VECTORIZE
    all.push_back (1);
#else
    all.push_back (0);
#endif
#ifdef WITH_TACTUS
    if (tactus::catalogue().find ("deform.plane") == nullptr) all.clear();   // the library is really used
#endif
    return all;
}

Body SIDE::made()
{
    Body b;
    b.mass = 2.5;
    b.wheel_loads << 1, 2, 3, 4;
    b.attitude = Eigen::Quaterniond (0.0, 1.0, 0.0, 0.0);
    b.place.translation() << 5, 6, 7;
    b.inertia = Eigen::MatrixXd::Constant (5, 5, 0.25);
    b.drag = 0.125;
    return b;
}

double SIDE::sum (const Body& b)
{
    return b.mass + b.wheel_loads.sum() + b.attitude.coeffs().sum() + b.place.matrix().sum() + b.inertia.sum() + b.drag;
}
