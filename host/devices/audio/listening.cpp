// SPDX-License-Identifier: MIT
#include "listening.hpp"
#include "resample_file.hpp"

#include <host/base/files/wav/wav_header.hpp>
#include <tactus/file/atomic_file.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>

namespace tactus::host
{

namespace
{
constexpr double wav_rate_hz = 48000.0;
constexpr double lowest_hz = 20.0;
constexpr double loudest = 0.7079457843841379;   // -3 dBFS

/// "motor.force" of "motor.force.x"; the whole name if it is not a component.
std::string portOf (const std::string& tap)
{
    const bool is_component = tap.ends_with (".x") || tap.ends_with (".y") || tap.ends_with (".z");
    return is_component ? tap.substr (0, tap.size() - 2) : tap;
}

/// The second-order Butterworth high-pass. Its poles are those of the low-pass.
Biquad highPass (double rate_hz)
{
    const auto low = butterworth2 (lowest_hz, rate_hz);
    const double k = prewarped (lowest_hz, rate_hz), b = low.b0 / (k * k);
    return { b, -2.0 * b, b, low.a1, low.a2 };
}

/// A WAV with one channel of 16-bit integers.
std::string wavOf (const std::vector<float>& samples, double gain)
{
    auto out = wavHeader (wav_rate_hz, 1, samples.size(), SampleFormat::pcm16);
    for (const float s : samples)
        appendInteger (out, static_cast<std::uint32_t> (std::lround (std::clamp (gain * double { s }, -1.0, 1.0) * 32767.0)), 2);
    return out;
}
}   // namespace

Result<> Listening::check (const std::string& file)
{
    if (std::filesystem::path (file).extension() != ".wav")
        return Message::error ("output/kind", file, "the file name does not end in .wav", "choose a name that ends in .wav");
    if (auto opened = AtomicFile::create (file); ! opened) return opened.error();
    return {};
}

Listening::Listening (std::string f, const std::vector<Tap>& taps, double rate, std::size_t per_tick)
    : file (std::move (f)), rate_hz (rate * static_cast<double> (per_tick)), high_pass (highPass (rate_hz)), filters (taps.size()),
      offsets (taps.size()), columns (taps.size())
{
    for (std::size_t i = 0; i < taps.size(); ++i)
    {
        if (i == 0 || portOf (taps[i].name) != portOf (taps[i - 1].name)) vectors.emplace_back();
        vectors.back().push_back (i);
    }
}

void Listening::frame (std::span<const double> values)
{
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        const auto tap = i % columns.size();
        if (columns[tap].empty()) offsets[tap] = values[i];   // a force that is there from the start is not a click
        columns[tap].push_back (static_cast<float> (filters[tap](high_pass, values[i] - offsets[tap])));
    }
}

std::vector<double> mainDirection (std::span<const std::vector<float>* const> components)
{
    const auto n = static_cast<Eigen::Index> (components.size());
    Eigen::MatrixXd moments = Eigen::MatrixXd::Zero (n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            for (std::size_t k = 0; k < components[0]->size(); ++k)
                moments (i, j) += double { (*components[static_cast<std::size_t> (i)])[k] } * double { (*components[static_cast<std::size_t> (j)])[k] };
    if (! moments.allFinite()) return {};
    Eigen::VectorXd most = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> (moments).eigenvectors().col (n - 1);
    Eigen::Index longest = 0;
    most.cwiseAbs().maxCoeff (&longest);
    if (most[longest] < 0.0) most = -most;   // a solver may return either direction
    return { most.begin(), most.end() };
}

std::vector<float> Listening::mixed() const
{
    std::vector<float> mix (columns[0].size());
    for (const auto& parts : vectors)
    {
        std::vector<const std::vector<float>*> components;
        for (const auto p : parts)
            components.push_back (&columns[p]);
        const auto most = mainDirection (components);
        if (most.empty()) continue;
        for (std::size_t k = 0; k < mix.size(); ++k)
            for (std::size_t i = 0; i < parts.size(); ++i)
                mix[k] += static_cast<float> (most[i] * double { (*components[i])[k] });
    }
    return mix;
}

Result<> Listening::write (Messages& warnings)
{
    auto mix = columns.empty() ? std::vector<float> {} : mixed();
    const auto samples = audio::resampled (std::move (mix), rate_hz, wav_rate_hz);
    double peak = 0.0;
    for (const float s : samples)
        peak = std::max (peak, std::abs (double { s }));
    if (peak < 1e-9)
        warnings.push_back (Message::warning ("listen/silent", file, "nothing moves faster than 20 Hz, so there is nothing to hear",
                                              "record a vibration, as in --record ring.value"));
    const auto bytes = wavOf (samples, peak < 1e-9 ? 0.0 : loudest / peak);
    auto opened = AtomicFile::create (file);
    if (! opened) return opened.error();
    if (! opened->stream().write (bytes.data(), static_cast<std::streamsize> (bytes.size()))) return opened->writeError();
    return opened->commit();
}

}   // namespace tactus::host
