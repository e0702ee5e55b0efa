// SPDX-License-Identifier: MIT
#include "modes_fit.hpp"
#include "least_squares.hpp"

#include <tactus/kit/at.hpp>
#include <tactus/kit/math/math.hpp>
#include <tactus/text/number_text.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace tactus
{

namespace
{
using detail::fitError;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr std::size_t fewest_ring_rows = 64;

/// The rows that are fitted. Times run from 0 in steps of dt, values are relative to the largest.
struct Ring
{
    VectorXd value;
    double dt = 0.0, largest = 0.0, start = 0.0, blow = 0.0;

    Index size() const { return value.size(); }
    double duration() const { return dt * static_cast<double> (size()); }
};

/// A tone in the search: frequency and decay, and the amplitudes of its cosine and sine.
struct Part
{
    double frequency, decay, cosine, sine;
};

/// The parameters of the search: ln frequency, ln decay, cosine and sine of each tone, then the coefficients of the drift.
class RingSearch
{
public:
    static constexpr Index per_tone = 4;

    RingSearch (const Ring& r, Index t, Index d, const FitCourse* c, bool skips = false) : ring (r), tones (t), drift (d), course (c)
    {
        const Index block = std::max<Index> (1, ring.size() / 50);
        weight = VectorXd::Ones (ring.size());
        for (Index i = 0; skips && i < ring.size(); ++i)
            if (i / block % 5 == 2) weight[i] = 0.0;
    }

    Index parameters() const { return per_tone * tones + drift; }
    bool isLeftOut (Index i) const { return weight[i] == 0.0; }
    static Part part (const VectorXd& x, Index tone)
    {
        return { math::exp (x[per_tone * tone]), math::exp (x[per_tone * tone + 1]), x[per_tone * tone + 2], x[per_tone * tone + 3] };
    }

    VectorXd modelled (const VectorXd& x) const
    {
        VectorXd sum = driftTerms() * x.tail (drift);
        for (Index k = 0; k < tones; ++k)
        {
            const auto p = part (x, k);
            visit (p, [&] (Index i, double, std::complex<double> z) { sum[i] += p.cosine * z.real() + p.sine * z.imag(); });
        }
        return sum;
    }

    MatrixXd slopes (const VectorXd& x) const
    {
        MatrixXd j (ring.size(), parameters());
        for (Index k = 0; k < tones; ++k)
        {
            const auto p = part (x, k);
            visit (p, [&] (Index i, double t, std::complex<double> z) {
                j (i, per_tone * k) = full_turn * p.frequency * t * (p.sine * z.real() - p.cosine * z.imag());
                j (i, per_tone * k + 1) = -p.decay * t * (p.cosine * z.real() + p.sine * z.imag());
                j (i, per_tone * k + 2) = z.real();
                j (i, per_tone * k + 3) = z.imag();
            });
        }
        j.rightCols (drift) = driftTerms();
        return j;
    }

    /// The parameters for these frequencies and decays, with the rest by linear least squares.
    VectorXd start (const std::vector<std::complex<double>>& rates) const
    {
        VectorXd x = VectorXd::Zero (parameters());
        for (Index k = 0; k < tones; ++k)
        {
            x[per_tone * k] = math::log (rates[at (k)].imag() / full_turn);
            x[per_tone * k + 1] = math::log (-rates[at (k)].real());
        }
        const MatrixXd all = slopes (x);
        MatrixXd linear (ring.size(), 2 * tones + drift);
        for (Index k = 0; k < tones; ++k)
            linear.middleCols (2 * k, 2) = all.middleCols (per_tone * k + 2, 2);
        linear.rightCols (drift) = all.rightCols (drift);
        const VectorXd amounts = (linear.transpose() * linear).ldlt().solve (linear.transpose() * ring.value);
        for (Index k = 0; k < tones; ++k)
            x.segment (per_tone * k + 2, 2) = amounts.segment (2 * k, 2);
        x.tail (drift) = amounts.tail (drift);
        return x;
    }

    detail::LeastSquares problem() const
    {
        return { .rows = ring.size(),
                 .residual = [this] (const VectorXd& x, VectorXd& r) { r = weight.cwiseProduct (ring.value - modelled (x)); },
                 .jacobian = [this] (const VectorXd& x, MatrixXd& j) { j = -(weight.asDiagonal() * slopes (x)); },
                 .size = std::sqrt (ring.value.squaredNorm() / static_cast<double> (ring.size())),
                 .course = course };
    }

private:
    /// Calls with the index, the time and e^((-decay + i 2 pi frequency) t) of each row.
    template <typename Visit>
    void visit (const Part& p, Visit visit) const
    {
        const auto [sine, cosine] = math::sinCos (std::fmod (full_turn * p.frequency * ring.dt, full_turn));
        const std::complex<double> factor = math::exp (-p.decay * ring.dt) * std::complex<double> { cosine, sine };
        std::complex<double> z = 1.0;
        for (Index i = 0; i < ring.size();
             ++i, z = { z.real() * factor.real() - z.imag() * factor.imag(), z.real() * factor.imag() + z.imag() * factor.real() })
            visit (i, ring.dt * static_cast<double> (i), z);
    }

    /// Chebyshev polynomials over the fitted part.
    MatrixXd driftTerms() const
    {
        MatrixXd terms (ring.size(), drift);
        for (Index i = 0; i < ring.size(); ++i)
        {
            const double u = 2.0 * static_cast<double> (i) / static_cast<double> (ring.size() - 1) - 1.0;
            for (Index k = 0; k < drift; ++k)
                terms (i, k) = k == 0 ? 1.0 : k == 1 ? u
                                                     : 2.0 * u * terms (i, k - 1) - terms (i, k - 2);
        }
        return terms;
    }

    const Ring& ring;
    Index tones, drift;
    const FitCourse* course;
    VectorXd weight;
};

/// The time of the blow before the fitted part: where the half-wave with the largest value begins. Looks back until the values have not grown for
/// half the length of the fitted part, so an earlier blow does not count.
double blowBefore (const RecordedRing& recorded, std::size_t from, std::size_t to)
{
    const auto& v = recorded.value;
    std::size_t largest = from;
    for (auto i = from; i-- > 0 && largest - i <= (to - from) / 2;)
        if (std::abs (v[i]) > std::abs (v[largest])) largest = i;
    if (largest == from) return recorded.time[from];
    const auto is_same_wave = [&] (std::size_t i) { return v[i] * v[largest] > 0.05 * v[largest] * v[largest]; };
    auto first = largest;
    while (first > 0 && is_same_wave (first))
        --first;
    return recorded.time[first];
}

Result<Ring> ringOf (const RecordedRing& recorded)
{
    if (auto checked = detail::checkColumns ({ &recorded.value, &recorded.time }, fewest_ring_rows, "the ring from the blow until it cannot be felt any more");
        ! checked)
        return checked.error();
    const auto step = detail::evenStep (recorded.time);
    if (! step) return step.error();
    const auto& v = recorded.value;
    const auto size = [&] (std::size_t i) { return std::abs (v[i]); };
    const auto rowAt = [&] (double t) { return at (std::ranges::lower_bound (recorded.time, t) - recorded.time.begin()); };

    double largest = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i)
        largest = std::max (largest, size (i));
    if (! (largest > 0.0)) return fitError ("fit/silent", "the recording is 0 throughout", "check which column is read");
    std::size_t from = 0, to = v.size();
    if (recorded.from)
        from = rowAt (*recorded.from);
    else
    {
        // A sensor that clips needs some time afterwards, and the blow may still last.
        const auto top = [&] (std::size_t i) { return size (i) >= 0.999 * largest; };
        std::size_t clipped = 0;
        for (std::size_t i = 0; i < v.size(); ++i)
            if (top (i)) ++clipped;
        for (std::size_t i = 0; i < v.size(); ++i)
            if (clipped >= 3 ? size (i) > 0.5 * largest : top (i)) from = i + 1;
    }
    if (recorded.to)
        to = rowAt (*recorded.to);
    else
    {
        double first = 0.0;
        for (std::size_t i = from; i < v.size(); ++i)
            first = std::max (first, size (i));
        while (to > from && ! (size (to - 1) > 0.05 * first))
            --to;
    }
    if (to < from + fewest_ring_rows)
        return fitError ("fit/too_short",
                         "the ring has " + std::to_string (to > from ? to - from : 0) + " rows; a fit needs at least " + std::to_string (fewest_ring_rows),
                         "record faster or longer, or choose another part of the recording");
    Ring ring { .value = Eigen::Map<const VectorXd> (v.data() + from, static_cast<Index> (to - from)), .dt = *step, .start = recorded.time[from] };
    ring.largest = ring.value.cwiseAbs().maxCoeff();
    if (! (ring.largest > 0.0)) return fitError ("fit/silent", "the fitted part is 0 throughout", "choose another part of the recording");
    ring.value /= ring.largest;
    const double earliest = recorded.time.front() - (recorded.time.back() - recorded.time.front());
    if (recorded.blow && ! (*recorded.blow >= earliest && *recorded.blow <= ring.start))
        return fitError ("fit/blow",
                         "the blow at " + roundedText (*recorded.blow, 4) + " s is "
                             + (*recorded.blow > ring.start ? "after the start of the fitted part" : "long before the recording"),
                         "give a time from " + roundedText (earliest, 4) + " s to " + roundedText (ring.start, 4) + " s, in the times of the recording");
    ring.blow = std::min (ring.start, recorded.blow.value_or (blowBefore (recorded, from, to)));
    return ring;
}

/// The values without a slow drift, averaged over `factor` rows.
VectorXd thinned (const Ring& ring, Index factor, Index drift)
{
    const VectorXd without = ring.value - RingSearch (ring, 0, drift, nullptr).modelled (RingSearch (ring, 0, drift, nullptr).start ({}));
    VectorXd few (ring.size() / factor);
    for (Index i = 0; i < few.size(); ++i)
        few[i] = without.segment (i * factor, factor).mean();
    return few;
}

/// The number of rows that can be averaged. About six averaged rows remain per period of the highest important frequency. The mean square of the
/// slope depends mostly on high frequencies, so noise keeps the number small.
Index thinning (const Ring& ring)
{
    const Index n = ring.size();
    Index factor = 1;
    while (n / (2 * factor) >= 4 * static_cast<Index> (fewest_ring_rows))
    {
        const VectorXd now = thinned (ring, factor, 1), next = thinned (ring, 2 * factor, 1);
        const double kept = next.squaredNorm() / static_cast<double> (next.size()) / (now.squaredNorm() / static_cast<double> (now.size()));
        if (! (kept > 0.93)) break;
        factor *= 2;
    }
    return factor;
}

/// The basis of the signal: eigenvectors of the matrix of products of delayed signals, strongest last.
MatrixXd delayBasis (const VectorXd& y)
{
    const Index n = y.size(), length = std::min<Index> (n / 3, 120) + 1;
    MatrixXd products (length, length);
    for (Index j = 0; j < length; ++j)
        products (0, j) = products (j, 0) = y.head (n - length + 1).dot (y.segment (j, n - length + 1));
    for (Index i = 1; i < length; ++i)
        for (Index j = i; j < length; ++j)
            products (i, j) = products (j, i) = products (i - 1, j - 1) + y[n - length + i] * y[n - length + j] - y[i - 1] * y[j - 1];
    return Eigen::SelfAdjointEigenSolver<MatrixXd> (products).eigenvectors();
}

/// Rates -decay + i 2 pi frequency of `count` tones.
std::vector<std::complex<double>> pencil (const MatrixXd& basis, Index count, double step, double duration)
{
    const auto strongest = basis.rightCols (2 * count);
    const MatrixXd first = strongest.topRows (basis.rows() - 1), second = strongest.bottomRows (basis.rows() - 1);
    const MatrixXd turn = first.householderQr().solve (second);
    const Eigen::VectorXcd poles = Eigen::EigenSolver<MatrixXd> (turn, false).eigenvalues();
    std::vector<std::complex<double>> rates;
    for (const auto& z : poles)
    {
        const double angle = math::atan2 (z.imag(), z.real()), decay = -math::log (std::max (1e-6, math::hypot (z.real(), z.imag()))) / step;
        if (angle > 0.0 && angle < std::numbers::pi * 0.999) rates.emplace_back (-std::max (decay, 0.1 / duration), angle / step);
    }
    return rates;
}

struct FoundRing
{
    Index tones = 0, drift = 1;
    detail::LeastSquaresFit fit;
    double score = std::numeric_limits<double>::infinity();
};

/// False if the frequency, decay or amplitude of a tone is outside its possible range, if a tone is too faint to matter, or if two tones are so
/// close that they describe one tone whose pitch or decay changes.
bool isRing (const VectorXd& x, Index tones, const Ring& ring)
{
    for (Index k = 0; k < tones; ++k)
    {
        const auto p = RingSearch::part (x, k);
        if (! (p.frequency * ring.dt < 0.5) || ! (p.frequency * ring.duration() > 1.0) || ! (p.decay * ring.duration() < 200.0) || ! (p.decay * ring.dt < 1.0))
            return false;
        if (! (p.decay > 1e-3 / ring.duration()) || ! (math::hypot (p.cosine, p.sine) < 10.0) || ! (p.decay < full_turn * p.frequency)) return false;
        for (Index l = 0; l < k; ++l)
        {
            const auto other = RingSearch::part (x, l);
            if (full_turn * std::abs (p.frequency - other.frequency) < p.decay + other.decay) return false;
        }
    }
    return true;
}

/// Tries increasing numbers of tones, until two more do not improve the fit.
FoundRing searchRing (const Ring& ring, int most, FitCourse* course)
{
    const Index factor = thinning (ring), slow = ring.size() > 400 ? 7 : 3;
    const double step = ring.dt * static_cast<double> (factor);
    const auto basis = delayBasis (thinned (ring, factor, slow));
    FoundRing best;
    constexpr double faint = 3e-3;   // share of the energy of the recording that another tone must explain
    double independent = 0.0;
    for (Index count = 1; count <= most && count <= best.tones + 2; ++count)
    {
        detail::setShare (course, 0.8 * static_cast<double> (count) / (most + 1));
        if (detail::isCancelled (course)) return best;
        const auto rates = pencil (basis, count, step, ring.duration());
        if (rates.empty()) continue;
        for (const Index drift : { Index { 1 }, slow })
        {
            const auto tones = static_cast<Index> (rates.size());
            const RingSearch search (ring, tones, drift, course);
            auto fit = detail::minimise (search.problem(), search.start (rates));
            if (! fit.x.allFinite() || ! isRing (fit.x, tones, ring)) continue;
            if (best.tones > 0 && tones > best.tones
                && ! (fit.sum() < best.fit.sum() - faint * static_cast<double> (tones - best.tones) * ring.value.squaredNorm()))
                continue;
            if (independent == 0.0 || best.tones > 0) independent = std::max (30.0, detail::independentRows (fit.residual));
            const double n = static_cast<double> (ring.size());
            const double score = n * math::log (fit.sumToCompare()) + static_cast<double> (search.parameters()) * math::log (n) * n / std::min (n, independent);
            if (score < best.score) best = { tones, drift, std::move (fit), score };
        }
    }
    return best;
}

double leftOut (const Ring& ring, const FoundRing& found, FitCourse* course)
{
    const RingSearch search (ring, found.tones, found.drift, course, true);
    const auto fit = detail::minimise (search.problem(), found.fit.x);
    const VectorXd off = ring.value - search.modelled (fit.x);
    double sum = 0.0, count = 0.0;
    for (Index i = 0; i < off.size(); ++i)
        if (search.isLeftOut (i))
        {
            sum += off[i] * off[i];
            count += 1.0;
        }
    return std::sqrt (sum / count);
}

void reportTones (const Ring& ring, const FoundRing& found, ModesFit& result)
{
    const auto& x = found.fit.x;
    const MatrixXd covariance = detail::covarianceOf (found.fit);
    const double freedom = detail::independentRows (found.fit.residual) - static_cast<double> (x.size());
    struct Row
    {
        ModesFit::Tone tone;
        double of_frequency, of_decay, of_amplitude;
    };
    std::vector<Row> rows;
    double all = 0.0;
    for (Index k = 0; k < found.tones; ++k)
    {
        const auto p = RingSearch::part (x, k);
        const Index i = RingSearch::per_tone * k;
        const double amplitude = math::hypot (p.cosine, p.sine);
        // ln amplitude at the blow, by ln decay, cosine and sine.
        const double since = p.decay * (ring.start - ring.blow);
        const Eigen::Vector3d along { since, p.cosine / (amplitude * amplitude), p.sine / (amplitude * amplitude) };
        const double energy = amplitude * amplitude / p.decay * (1.0 - math::exp (-2.0 * p.decay * ring.duration()));
        rows.push_back ({ { p.frequency, p.decay, ring.largest * amplitude * math::exp (since), math::atan2 (p.cosine, p.sine), energy },
                          std::sqrt (covariance (i, i)),
                          std::sqrt (covariance (i + 1, i + 1)),
                          std::sqrt (detail::varianceAlong (covariance, i + 1, along)) });
        all += energy;
    }
    std::ranges::sort (rows, {}, [] (const Row& r) { return r.tone.frequency; });
    for (std::size_t k = 0; k < rows.size(); ++k)
    {
        auto& [tone, of_frequency, of_decay, of_amplitude] = rows[k];
        tone.energy /= all;
        const auto name = "mode " + std::to_string (k + 1);
        const bool is_main = tone.energy > 0.05;
        result.tones.push_back (tone);
        result.report.values.push_back (detail::withLogInterval (name + " frequency", "Hz", tone.frequency, of_frequency, freedom, is_main));
        result.report.values.push_back (detail::withLogInterval (name + " decay", "1/s", tone.decay, of_decay, freedom, is_main));
        result.report.values.push_back (detail::withLogInterval (name + " amplitude", "", tone.amplitude, of_amplitude, freedom, is_main));
    }
}
}   // namespace

Result<ModesFit> fitModes (const RecordedRing& recorded, FitCourse* course)
{
    auto read = ringOf (recorded);
    if (! read) return read.error();
    const auto& ring = *read;
    const auto found = searchRing (ring, recorded.most_modes, course);
    if (detail::isCancelled (course)) return detail::fitCancelled();
    if (found.tones == 0)
        return fitError ("fit/no_ring", "no decaying tone explains the recording", "check which column is read, and that the recording begins at the blow");

    ModesFit result { .start = ring.start, .blow = ring.blow };
    auto& report = result.report;
    reportTones (ring, found, result);
    const RingSearch search (ring, found.tones, found.drift, course);
    const VectorXd modelled = ring.largest * search.modelled (found.fit.x);
    report.rows = static_cast<std::size_t> (ring.size());
    report.residual = ring.largest * std::sqrt (found.fit.sum() / static_cast<double> (ring.size()));
    report.left_out_residual = ring.largest * leftOut (ring, found, course);
    report.size = ring.largest * std::sqrt (ring.value.squaredNorm() / static_cast<double> (ring.size()));
    report.notes.push_back ("fitted from " + roundedText (ring.start, 4) + " s to " + roundedText (ring.start + ring.duration(), 4)
                            + " s; the amplitudes are those at the blow, at " + roundedText (ring.blow, 4) + " s");
    std::vector<double> t;
    for (Index i = 0; i < ring.size(); ++i)
        t.push_back (ring.start + ring.dt * static_cast<double> (i));
    report.picture = {
        "time", "s", "ring", "", { { "recorded", recorded.time, recorded.value, true }, { "fitted", t, { modelled.begin(), modelled.end() } } }
    };
    if (detail::isCancelled (course)) return detail::fitCancelled();
    judge (report, "Strike once, cleanly, and record until the ring has died away, at a sample rate of at least five times the highest frequency.");
    return result;
}

}   // namespace tactus
