// SPDX-License-Identifier: MIT
#include "modes_fit.hpp"
#include "even_clock.hpp"
#include "least_squares.hpp"
#include "ring_search.hpp"
#include "ring_sums.hpp"

#include <tactus/kit/at.hpp>
#include <tactus/kit/math/math.hpp>
#include <tactus/text/number_text.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus
{

namespace
{
using detail::fitError;
using detail::full_turn;
using detail::RingModel;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t fewest_ring_rows = 64;

/// The rows that are fitted. Times run from 0 in steps of dt, values are relative to the largest.
struct Ring
{
    VectorXd value;
    double dt = 0.0, largest = 0.0, start = 0.0, blow = 0.0;

    Index size() const { return value.size(); }
    double duration() const { return dt * static_cast<double> (size()); }
    double meanSquare() const { return value.squaredNorm() / static_cast<double> (size()); }
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

/// The default start: after the largest value, because the blow may still last. If the ring beats, its largest value may come long after the blow, so
/// an earlier half-wave that is more than half as large counts, unless the time between them is long.
std::size_t startOfRing (const std::vector<double>& v, double largest)
{
    const auto size = [&] (std::size_t i) { return std::abs (v[i]); };
    std::size_t clipped = 0, last_large = 0, top = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
    {
        if (size (i) >= 0.999 * largest) ++clipped;
        if (size (i) >= 0.5 * largest) last_large = i;
        if (size (i) > size (top)) top = i;
    }
    if (clipped >= 3) return last_large + 1;   // a sensor that clips needs some time afterwards
    auto first = top;
    const auto longest_gap = std::max<std::size_t> (16, v.size() / 50);
    for (auto i = top; i-- > 0 && first - i <= longest_gap;)
        if (size (i) > 0.5 * largest) first = i;
    while (first + 1 < v.size() && size (first + 1) > size (first))
        ++first;
    return first + 1;
}

/// The default end: that of the recording. In a long one, silence after the ring is at most three times as long as the ring.
std::size_t endOfRing (const std::vector<double>& v, std::size_t from)
{
    constexpr std::size_t blocks = 200, is_short = 1 << 16;
    if (v.size() <= from + is_short) return v.size();
    const auto rows = (v.size() - from) / blocks;
    std::vector<double> squares (blocks);
    for (std::size_t i = 0; i < blocks * rows; ++i)
        squares[i / rows] += v[from + i] * v[from + i];
    const double silence = *std::ranges::min_element (squares);
    auto loud = blocks;
    while (loud > 1 && ! (squares[loud - 1] > 2.0 * silence))
        --loud;
    return std::min (v.size(), from + std::max (is_short, 4 * (loud + 1) * rows));
}

/// The part to fit, from rows that are `step` apart.
Result<Ring> ringOf (const RecordedRing& recorded, double step)
{
    const auto& v = recorded.value;
    const auto size = [&] (std::size_t i) { return std::abs (v[i]); };
    const auto rowAt = [&] (double t) { return at (std::ranges::lower_bound (recorded.time, t) - recorded.time.begin()); };

    double largest = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i)
        largest = std::max (largest, size (i));
    if (! (largest > 0.0)) return fitError ("fit/silent", "the recording is 0 throughout", "check which column is read");
    const std::size_t from = recorded.from ? rowAt (*recorded.from) : startOfRing (v, largest), to = recorded.to ? rowAt (*recorded.to) : endOfRing (v, from);
    if (to < from + fewest_ring_rows)
        return fitError ("fit/too_short",
                         "the ring has " + std::to_string (to > from ? to - from : 0) + " rows; a fit needs at least " + std::to_string (fewest_ring_rows),
                         "record faster or longer, or choose another part of the recording");
    Ring ring { .value = Eigen::Map<const VectorXd> (v.data() + from, static_cast<Index> (to - from)), .dt = step, .start = recorded.time[from] };
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

/// Tones that describe one mode: each of the others is so close to the first and strongest one that both may be one tone whose pitch or decay changes.
using Cluster = std::vector<detail::DecayingTone>;

std::vector<Cluster> clustersOf (const RingModel& found)
{
    const auto gains = found.gains();
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < gains.size(); ++k)
        order.push_back (k);
    std::ranges::sort (order, std::greater<> {}, [&] (std::size_t k) { return gains[k]; });
    std::vector<Cluster> clusters;
    for (const auto k : order)
    {
        const auto& tone = found.tones[k];
        const auto is_close = [&] (const Cluster& other) {
            return std::norm (tone.rate - other.front().rate) < std::pow (tone.rate.real() + other.front().rate.real(), 2);
        };
        const auto own = std::ranges::find_if (clusters, is_close);
        const bool is_click = -tone.rate.real() > 0.99 * std::min (tone.rate.imag(), detail::fastest_decay);   // as fast as the search allows
        if (own != clusters.end())
            own->push_back (tone);
        else if (! is_click)
            clusters.push_back ({ tone });
    }
    return clusters;
}

/// One mode for each cluster, at most `most`, all refined together.
RingModel refined (const Ring& ring, const RingModel& found, int most, const FitCourse* course)
{
    const auto clusters = clustersOf (found);
    std::vector<std::complex<double>> rates;
    for (const auto& cluster : clusters)
        if (rates.size() < static_cast<std::size_t> (most)) rates.push_back (cluster.front().rate);
    return rates.size() == found.tones.size() ? found : detail::fitRing (ring.value, rates, found.drift.size(), 50, course);
}

/// The modes. If some tones leave only noise, each cluster of them becomes the mode that is most like it, and the other modes stay as they are. If no
/// number of tones leaves only noise, the object does not ring in modes alone. Then the faint tones may just make up for what the strong ones are
/// not, so a mode must stand out from the whole residual.
RingModel modesOf (const Ring& ring, int most, double least, FitCourse* course)
{
    constexpr int doubles = 8;
    const auto found = detail::searchRing (ring.value, ring.size() > 400 ? 5 : 3, most + doubles, least, course);
    const auto rows = static_cast<double> (ring.size());
    if (const auto clusters = clustersOf (found.model); found.is_whole && clusters.size() <= at (most))
    {
        RingModel modes { .drift = found.model.drift, .rows = ring.size() };
        for (const auto& cluster : clusters)
            modes.tones.push_back (cluster.size() == 1
                                       ? cluster.front()
                                       : detail::fitRing (RingModel { .tones = cluster, .rows = ring.size() }.values(), { cluster.front().rate }, 0, 50, course)
                                             .tones.front());
        return modes;
    }
    auto modes = refined (ring, found.model, most, course);
    for (std::size_t before = 0; before != modes.tones.size();)   // each mode that goes raises the floor for the others
    {
        before = modes.tones.size();
        const double floor = modes.sum / rows;
        modes = detail::withoutFaint (
            ring.value, std::move (modes), [floor] (double) { return floor; }, detail::ResidualSpectrum::thresholdOf (rows), course);
        modes = refined (ring, modes, most, course);
    }
    return modes;
}

/// The residual of rows that were left out of the fit. The fit to the others follows from one Gauss-Newton step.
double leftOut (const RingModel& model, const VectorXd& residual)
{
    const Index rows = residual.size(), block = std::max<Index> (1, rows / 50), p = model.parameters();
    MatrixXd products = MatrixXd::Zero (p, p);
    VectorXd slopes = VectorXd::Zero (p);
    double squares = 0.0, count = 0.0;
    for (Index begin = 2 * block; begin < rows; begin += 5 * block)
    {
        const Index end = std::min (rows, begin + block);
        products += model.products (begin, end);
        slopes += model.productsWith (residual, begin, end);
        squares += residual.segment (begin, end - begin).squaredNorm();
        count += static_cast<double> (end - begin);
    }
    const MatrixXd kept = model.products (0, rows) - products;
    const VectorXd pull = model.productsWith (residual, 0, rows) - slopes;
    const VectorXd scale = kept.diagonal().cwiseMax (1e-300).cwiseSqrt().cwiseInverse();
    const VectorXd step = scale.asDiagonal() * (scale.asDiagonal() * kept * scale.asDiagonal()).fullPivLu().solve (scale.asDiagonal() * pull);
    return std::sqrt (std::max (0.0, squares - 2.0 * step.dot (slopes) + step.dot (products * step)) / count);
}

/// The covariance of the parameters. Each tone is fitted in a narrow band, so the noise there counts.
MatrixXd covarianceOf (const Ring& ring, const RingModel& model, const VectorXd& residual)
{
    VectorXd angles = VectorXd::Zero (model.parameters());
    for (std::size_t k = 0; k < model.tones.size(); ++k)
        angles.segment<4> (4 * static_cast<Index> (k)).setConstant (model.tones[k].rate.imag());
    const VectorXd errors = detail::errorPowers (residual, angles, std::sqrt (ring.meanSquare())).cwiseSqrt();
    const MatrixXd normal = model.products (0, ring.size());
    const VectorXd scale = normal.diagonal().cwiseMax (1e-300).cwiseSqrt().cwiseInverse();
    const MatrixXd inverse = (scale.asDiagonal() * normal * scale.asDiagonal()).fullPivLu().inverse();
    const VectorXd factor = scale.cwiseProduct (errors);
    return factor.asDiagonal() * inverse * factor.asDiagonal();
}

void reportTones (const Ring& ring, const RingModel& model, const VectorXd& residual, ModesFit& result)
{
    const MatrixXd covariance = covarianceOf (ring, model, residual);
    const double freedom = detail::independentRows (residual) - static_cast<double> (model.parameters());
    struct Row
    {
        ModesFit::Tone tone;
        double of_frequency, of_decay, of_amplitude;
    };
    std::vector<Row> rows;
    double all = 0.0;
    for (std::size_t k = 0; k < model.tones.size(); ++k)
    {
        const auto [rate, a] = model.tones[k];
        const auto i = 4 * static_cast<Index> (k);
        const double decay = -rate.real() / ring.dt, size = math::hypot (a.real(), a.imag()), since = (ring.start - ring.blow) / ring.dt;
        // ln amplitude at the blow, by the decay and the two parts of the amplitude.
        Eigen::Vector3d along { since, a.real() / (size * size), a.imag() / (size * size) };
        const std::vector<Index> of_amplitude { i, i + 2, i + 3 };
        const auto deviation = [] (double variance) { return variance >= 0.0 ? std::sqrt (variance) : std::numeric_limits<double>::infinity(); };
        const double energy = size * size / decay * (1.0 - math::exp (-2.0 * decay * ring.duration()));
        rows.push_back ({ { .frequency = rate.imag() / full_turn / ring.dt,
                            .decay = decay,
                            .amplitude = ring.largest * size * math::exp (-rate.real() * since),
                            .phase = math::atan2 (a.real(), -a.imag()),
                            .energy = energy },
                          deviation (covariance (i + 1, i + 1)) / rate.imag(),
                          deviation (covariance (i, i)) / -rate.real(),
                          deviation (along.dot (covariance (of_amplitude, of_amplitude) * along)) });
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

/// Reports what the modes do not explain: tones that stand out from the noise, and a residual that decays, as noise does not.
void examineResidual (const Ring& ring, const VectorXd& residual, double least, FitReport& report)
{
    if (const detail::ResidualSpectrum spectrum (residual, least); spectrum.strongest())
        report.lacking.push_back ("a tone at " + roundedText (spectrum.loudest() / full_turn / ring.dt, 4)
                                  + " Hz is left in the residual: more modes are needed (--most), or a mode changes its pitch, or is two modes that are "
                                    "closer than their bandwidths");
    const Index third = ring.size() / 3;
    const auto rows = static_cast<double> (third);
    const double early = residual.head (third).squaredNorm() / rows, late = residual.tail (third).squaredNorm() / rows;
    const double chance = 5.0 * std::sqrt (12.0 / std::max (12.0, detail::independentRows (residual)));
    if (early > (1.0 + chance) * std::max (late, least))
        report.lacking.push_back ("the residual decays with the ring, so it is not noise: the decay of the modes is not exponential, or the blow still lasts");
}
}   // namespace

Result<ModesFit> fitModes (const RecordedRing& given, FitCourse* course)
{
    auto recorded = given;
    if (auto checked = detail::checkColumns ({ &recorded.value, &recorded.time }, fewest_ring_rows, "the ring from the blow until it cannot be felt any more");
        ! checked)
        return checked.error();
    const auto clock = detail::ontoEvenClock (recorded.time, { &recorded.value });
    if (! clock) return clock.error();
    auto read = ringOf (recorded, clock->step);
    if (! read) return read.error();
    const auto& ring = *read;
    constexpr double finest = 1e-6;   // error of a sensor over the size of the signal
    const double least = finest * finest * ring.meanSquare();
    const auto found = modesOf (ring, recorded.most_modes, least, course);
    if (detail::isCancelled (course)) return detail::fitCancelled();
    if (found.tones.empty())
        return fitError ("fit/no_ring", "no decaying tone explains the recording", "check which column is read, and that the recording begins at the blow");

    ModesFit result { .start = ring.start, .blow = ring.blow };
    auto& report = result.report;
    const VectorXd modelled = found.values(), residual = ring.value - modelled;
    reportTones (ring, found, residual, result);
    report.rows = static_cast<std::size_t> (ring.size());
    report.residual = ring.largest * std::sqrt (residual.squaredNorm() / static_cast<double> (ring.size()));
    report.left_out_residual = ring.largest * leftOut (found, residual);
    report.size = ring.largest * std::sqrt (ring.meanSquare());
    // Times since 1970 need more digits to differ.
    const double end = ring.start + ring.duration();
    const int digits = 4 + static_cast<int> (std::log10 (std::max (1.0, end / ring.duration())));
    report.notes.push_back ("fitted from " + roundedText (ring.start, digits) + " s to " + roundedText (end, digits)
                            + " s; the amplitudes are those at the blow, at " + roundedText (ring.blow, digits) + " s");
    std::vector<double> t, fitted;
    for (Index i = 0; i < ring.size(); ++i)
    {
        t.push_back (ring.start + ring.dt * static_cast<double> (i));
        fitted.push_back (ring.largest * modelled[i]);
    }
    report.picture = { "time", "s", "ring", "", { { "recorded", recorded.time, recorded.value, true }, { "fitted", t, fitted } } };
    examineResidual (ring, residual, least, report);
    clock->tell (report);
    judge (report, "Strike once, cleanly, and record until the ring has died away, at a sample rate of at least five times the highest frequency.",
           std::numeric_limits<double>::infinity());
    return result;
}

}   // namespace tactus
