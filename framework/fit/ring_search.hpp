// SPDX-License-Identifier: MIT
#pragma once

#include "ring_model.hpp"

#include <functional>
#include <optional>

namespace tactus::detail
{

/// A tone in a residual, and how far it stands out.
struct HiddenTone
{
    std::complex<double> rate;   ///< per row
    double score = 0.0;          ///< power over the noise around it, in a spectrum weighted with the decay of the tone
};

/// The noise floor of a residual, and the tone that stands out the most.
class ResidualSpectrum
{
public:
    /// `least` is the smallest power of noise that a recording can have, per row.
    ResidualSpectrum (const Eigen::VectorXd& residual, double least);

    /// The power of the noise per row, as it is around this angle per row.
    double floorAt (double angle) const;

    /// The power over the noise that noise alone exceeds in one of a thousand recordings.
    double threshold() const { return limit; }
    static double thresholdOf (double rows);   ///< the same if the floor is known

    const std::optional<HiddenTone>& strongest() const { return found; }

    /// Of all that stands out, the angle per row with the most power: where a tone is, rather than its skirts over a lower floor. 0 if nothing does.
    double loudest() const { return loudest_angle; }

private:
    std::vector<double> floors;   // of bands of equal width
    double limit = 0.0;
    std::optional<HiddenTone> found;
    double loudest_angle = 0.0;
};

/// Removes the faintest tone, and refines the others, until the power of each over the noise floor exceeds `least`.
RingModel withoutFaint (const Eigen::VectorXd& signal, RingModel, const std::function<double (double angle)>& floor, double least, const FitCourse*);

struct FoundRing
{
    RingModel model;
    bool is_whole = false;   ///< nothing but noise is left
};

/// Finds the tones in a signal: adds the tone that stands out the most from the residual, refines all tones together, removes those that do not stand
/// out any more, and repeats this until no tone stands out.
FoundRing searchRing (const Eigen::VectorXd& signal, Eigen::Index drift, int most_tones, double least, FitCourse*);

}   // namespace tactus::detail
