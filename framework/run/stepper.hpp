// SPDX-License-Identifier: MIT
#pragma once

#include "run.hpp"
#include <tactus/run/device/step_motion.hpp>

#include <cstddef>
#include <vector>

namespace tactus
{

/// Ticks a run in the steps of another loop, such as a physics engine at 50 to 1000 Hz over a graph at 1 to 20 kHz.
///
///     Stepper steps { run };
///     steps.add (tool.motion);      // of your own device: see StepMotion
///     for (;;)
///     {
///         tool.reading = …;         // where the tool is now
///         steps.step (dt);          // the ticks of this step
///         … = tool.motion.effort(); // on the tool during the next step
///     }
///
/// A guard that has stopped a role gives no force. `run.engine().guardOf ("stylus")` says so: stop() is the cause, isLatched() that it lasts until
/// Engine::rearm(), isClipping() that the limits shorten the force, and describe (guard.latest()) gives the reason with its numbers.
class Stepper
{
public:
    static constexpr double longest_s = 1.0;   ///< a longer step must be a mistake

    explicit Stepper (Run& r) noexcept : run (r) {}

    /// A motion that must outlive this object. [main thread, before the first step]
    void add (StepMotion& motion) { motions.push_back (&motion); }

    /// Runs the ticks that are due `dt_s` after the last step, and returns how many. What remains of a period is kept for the next step, so that steps of
    /// 1/60 s at 4 kHz have 66, 67 and 67 ticks. Runs none, and returns 0, if dt_s is not positive or longer than longest_s. A step that is shorter than
    /// a period may return 0, too. [tick thread]
    std::size_t step (double dt_s) noexcept
    {
        if (! (dt_s > 0.0 && dt_s <= longest_s)) return 0;
        const double due = remainder + dt_s * run.rate();
        const auto ticks = static_cast<std::size_t> (due + rounding);
        remainder = due - static_cast<double> (ticks);
        for (auto* motion : motions)
            motion->begin (ticks, 1.0 / run.rate());
        for (std::size_t i = 0; i < ticks; ++i)
            run.tick();
        return ticks;
    }

    /// The rest of a period belongs to the state of the loop, beside that of the run. [tick thread]
    void serialize (auto& archive) { archive (remainder); }

private:
    static constexpr double rounding = 1e-6;   // of a period: 0.002 s at 4 kHz are 8 ticks, whatever the last bits are

    Run& run;
    std::vector<StepMotion*> motions;
    double remainder = 0.0;   // of a period
};

}   // namespace tactus
