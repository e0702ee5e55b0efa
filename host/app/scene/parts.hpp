// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene.hpp"

namespace tactus::host::scene
{

/// The direction of a blade's edge, within a surface with this normal.
Vec3 bladeDirection (const Body&, std::size_t number, const SceneState&, const Vec3& normal);

}   // namespace tactus::host::scene
