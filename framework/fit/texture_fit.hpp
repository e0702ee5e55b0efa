// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"

namespace tactus
{

/// A tool that was dragged over a texture at one or more speeds and forces.
struct RecordedTexture
{
    std::vector<double> time {};                       ///< s, evenly spaced, give or take less than half a step
    std::vector<double> acceleration {};               ///< of the tool, in m/s2
    std::vector<double> speed {};                      ///< m/s; empty: not recorded
    std::vector<double> force {};                      ///< N, normal to the surface; empty: not recorded
    double assumed_speed = 0.1, assumed_force = 1.0;   ///< used if they were not recorded
    int most_coefficients = 20;
};

/// Autoregressive models, y_n = sum_k a_k y_(n-k) + e_n, as texture.noise plays them.
struct TextureFit
{
    struct Model
    {
        double speed = 0.0, force = 0.0;   // m/s, N: means of the rows
        std::vector<double> coefficients {};
        double variance = 0.0;       // of e, in (m/s2)^2
        double sensor_noise = 0.0;   // variance of white noise added to y, which is not part of the texture, in (m/s2)^2
        std::size_t rows = 0;
    };

    double rate = 0.0;   ///< Hz
    std::vector<Model> models {};
    FitReport report {};
};

/// Groups the rows by speed and force, and fits a model to each group: the spectrum sigma^2 / |A|^2, plus a white floor for the noise of the
/// sensor, which would otherwise make the texture duller than it is. The fit minimises the squares of the deviance residuals, which is maximum
/// likelihood in Whittle's approximation. BIC selects the number of coefficients. Every model is stable. The intervals follow from the Fisher
/// information. For the cross-validation, a model of the first half of each group predicts the second half, one row ahead.
///
/// Errors: fit/too_short, fit/not_finite, fit/time, fit/uneven, fit/at_rest, fit/silent, fit/cancelled. [any thread]
///
/// Source: Culbertson, Unwin & Kuchenbecker 2014 (models); Whittle 1953 (likelihood); Burg 1967 (start values).
Result<TextureFit> fitTexture (const RecordedTexture&, FitCourse* = nullptr);

}   // namespace tactus
