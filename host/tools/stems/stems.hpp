// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Stems: the signals that a graph sends to its motors, and each part of them, as WAV files for other programs.

#include "sink_mixes.hpp"

#include <host/base/files/wav/wav_header.hpp>
#include <tactus/plan/plan.hpp>
#include <tactus/text/result.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

/// The endings of the clip files that stems can be written as: haptic, ahap, hjif.
const std::vector<std::string>& stemClipFormats();

struct StemOptions
{
    SampleFormat format = SampleFormat::float32;
    double rate_hz = 0.0;     ///< of the files, in whole Hz; 0: the rate of the samples
    double loop_s = 0.0;      ///< the end is blended into the start over this time, so that a file can be repeated without a click; 0: no blend
    bool is_mono = false;     ///< vectors become their component in the direction in which the mix of their motor moves most, if that mix is one vector
    bool has_dither = true;   ///< integers get triangular noise, one step wide on each side, the same in each export; silence stays silence

    enum class Scale
    {
        physical,   ///< a sample of 1 is `full_scale` units
        together,   ///< the loudest sample of all files is at -1 dBFS: the files still add up
        each        ///< the loudest sample of each file is at -1 dBFS
    };
    Scale scale = Scale::physical;
    double full_scale = 1.0;

    /// Formats of stemClipFormats() in which each layer and each signal that is not mixed is also written as a clip of one signal. Amplitude 1 is the
    /// loudest sample of all clips, so that they keep their proportions; with Scale::each, that of the clip.
    std::vector<std::string> clips {};
};

/// A file that was written.
struct WrittenStem
{
    std::string file {}, kind {}, label {}, from {};   ///< kind: "mix", "axis", "layer", "not_mixed" or "clip"; from: the port
    std::vector<std::string> channels {};              ///< "motor.force.x"
    std::vector<std::string> not_applied {};           ///< the nodes that this signal, which is not mixed, passes on its way to the motor
    std::string unit {};                               ///< SI symbol, "" if unknown
    double full_scale = 1.0;                           ///< the value of a sample of 1, in this unit
    double peak = 0.0;                                 ///< in the unit
    std::size_t clipped = 0;                           ///< samples beyond full scale
};

struct WrittenStems
{
    std::vector<WrittenStem> files {};
    double rate_hz = 0.0;
    std::size_t frames = 0;

    /// A comparison of the mix of a run with the sum of its layers.
    struct Sum
    {
        std::string mixer, unit;
        double difference = 0.0, peak = 0.0;   ///< the largest values, in the unit
    };
    std::vector<Sum> sums {};
    Messages losses {};   ///< what clips cannot hold, each kind once
};

/// The file in a folder that lists the stems that were written into it.
inline constexpr const char* list_of_stems = "tactus_stems.txt";

/// Records the parts of a run: the signals of all actuators of each role, each of these signals, each layer of the mixers before them, and the
/// signals that reach them without a mixer. A layer is recorded as its mixer adds it: after gain, mute, solo, ducking and ceiling.
class Stems
{
public:
    /// The ports that the plan must tap (CompileOptions::records).
    static std::vector<std::string> portsOf (const plan::Flat&);

    /// `run`: a plan that taps these ports, before its first tick. It must outlive this object.
    Stems (const Plan& run, const StemOptions&);
    ~Stems();

    /// Takes the samples of a tick. Id: stems/too_long.
    Result<> frame();

    /// Writes the files, with stems.json, into a folder that is new, empty or written earlier by this function.
    /// Ids: stems/nothing, stems/loop, wav/sample_rate, and those of AtomicFolder.
    Result<WrittenStems> write (const std::filesystem::path& folder, const std::string& name);

    /// Checks before the run that write() will accept a folder.
    static Result<> check (const std::filesystem::path& folder);

private:
    struct Impl;
    std::unique_ptr<Impl> impl;
};

}   // namespace tactus::host
