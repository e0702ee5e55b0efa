// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/at.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tactus
{

/// Keeps the samples of a short window of time, and tells by how much a quantity has changed in this time.
///
/// The difference of two neighbouring samples depends on the tick rate: one quantum of an encoder in one tick is a speed that grows with
/// the rate. The change over a fixed time does not depend on it.
template <typename T>
class PastWindow
{
public:
    struct Change
    {
        T by;                ///< the sample minus the oldest one in the window
        double time = 0.0;   ///< between these two samples, in s; 0 if there is no older sample
    };

    /// A window of one tick. `dt_s` holds until prepare() is called.
    explicit PastWindow (double dt_s) : dt (dt_s) {}

    /// `window_s` is rounded to ticks, at least one. Forgets all samples. Allocates.
    void prepare (double window_s, double dt_s)
    {
        dt = dt_s;
        samples = std::vector<T> (at (std::max (1L, std::lround (window_s / dt_s))));
        clear();
    }

    void clear() noexcept { known = newest = 0; }

    /// The change from the oldest sample to this one, which `remember` has not stored yet.
    Change to (const T& sample) const noexcept
    {
        if (known == 0) return { sample - sample, 0.0 };
        return { sample - ago (known - 1), known * dt };
    }

    /// The newest sample. There must be one.
    const T& last() const noexcept { return ago (0); }

    bool isEmpty() const noexcept { return known == 0; }

    /// Stores a sample. If the window is full, the oldest sample is forgotten.
    void remember (const T& sample) noexcept
    {
        newest = newest + 1 < capacity() ? newest + 1 : 0;
        samples[at (newest)] = sample;
        known = std::min (known + 1, capacity());
    }

    /// Stores a sample that is a number. Anything else makes the window forget all samples.
    void remember (const T& sample, bool is_number) noexcept
    {
        if (is_number)
            remember (sample);
        else
            clear();
    }

    /// Copies the newest samples of another window, as many as this one can hold. Allocates nothing.
    void adopt (const PastWindow& old) noexcept
    {
        clear();
        for (int i = std::min (old.known, capacity()) - 1; i >= 0; --i)
            remember (old.ago (i));
    }

    void serialize (auto& archive)
    {
        archive.expect (samples.size());
        archive.index (newest, samples.size());
        archive.index (known, samples.size() + 1);
        for (int i = 0; i < known; ++i)   // nothing has been stored in the others
            archive (samples[at (newest - i >= 0 ? newest - i : newest - i + capacity())]);
    }

private:
    int capacity() const noexcept { return static_cast<int> (samples.size()); }

    const T& ago (int ticks) const noexcept
    {
        const int place = newest - ticks;
        return samples[at (place >= 0 ? place : place + capacity())];
    }

    std::vector<T> samples = std::vector<T> (1);
    int newest = 0, known = 0;
    double dt;   // s
};

}   // namespace tactus
