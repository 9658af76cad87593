// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/base/brief.hpp>
#include <stickslip/base/require.hpp>
#include <stickslip/base/types.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace stickslip {

/// How far a run goes and in what steps. Times are in the unit of the motions and drives.
struct MarchOptions {
  Real end = 1;
  Index steps = 0;              ///< number of equal steps; 0: choose the size automatically
  Real initial = 0;             ///< first automatic step; 0: a hundredth of the way to the end
  Real largest = 0;             ///< largest automatic step; 0: no limit
  Real smallest = 0;            ///< below it a step is given up; 0: 1e-9 of the way
  Index target_iterations = 4;  ///< automatic steps grow below this count and shrink above
  Real tolerance = 1e-5;        ///< of Newton's method, see NewtonOptions
  Real time_tolerance = 0;      ///< with inertia: limit of a step's local error (theory.md, eq. 7.8) [length]; 0: none
  Real lag_tolerance = 0;   ///< that automatic steps aim at, see ErrorEstimates::lag (theory.md, eq. 6.10) [-]; 0: none
  Real step_tolerance = 0;  ///< the same for ErrorEstimates::time
  Index max_iterations = 20;    ///< of Newton's method
  Real outer_tolerance = 1e-4;  ///< of outer iterations, where the model takes them (theory.md, eq. 4.18 and 5.31) [-]
  Index max_outer = 30;         ///< over a step
  Index mesh_error_interval = 0;  ///< steps from one estimate of the mesh's error to the next; 0: none
  bool line_search = true;
  bool detect_tunnelling = true;  ///< reject a step over which a node goes through a tool (theory.md, eq. 4.20)
  bool detect_lag_instability =
      true;  ///< probe lagging bounds that swing, and at the end, and give up where they feed back
  Real energy_gain =
      1e-3;  ///< with inertia: energy that the time scheme may gain over the largest of the work done and
             ///< the energy at the start (theory.md, eq. 7.17); beyond it the run warns [-]; 0: not looked at
  bool refuse_energy_gain = false;  ///< ends the run there instead
  std::vector<Real> stops{};        ///< times that a step must end at

  /// Throws std::invalid_argument, naming what is wrong, for a run that begins at the time `now`.
  void validate(Real now) const {
    const auto refuse = [](const std::string& what) { throw std::invalid_argument("march: " + what); };
    if (!(end > now) || !std::isfinite(end)) refuse("the end must lie after the present time");
    if (steps < 0) refuse("the number of steps must not be negative");
    if (!(initial >= 0 && largest >= 0 && smallest >= 0)) refuse("step sizes must not be negative");
    require::finite(initial, "march: the first step size");
    require::finite(largest, "march: the largest step size");
    require::finite(smallest, "march: the smallest step size");
    if (target_iterations < 1) refuse("target_iterations must be positive");
    if (!(tolerance > 0 && tolerance < 1)) refuse("the tolerance must lie between 0 and 1");
    if (max_iterations < 1) refuse("needs at least one iteration");
    if (max_outer < 1) refuse("needs at least one pass");
    if (mesh_error_interval < 0) refuse("the steps between estimates must not be negative");
    require::positive(outer_tolerance, "march: the pass tolerance");
    require::not_negative(time_tolerance, "march: the time tolerance");
    require::not_negative(lag_tolerance, "march: the lag tolerance");
    require::not_negative(step_tolerance, "march: the step tolerance");
    require::not_negative(energy_gain, "march: the energy gain");
    for (const Real stop : stops)
      if (!std::isfinite(stop)) refuse("every stop must be finite");
    const Real resolved = resolution(now);
    const auto resolve = [&](Real size, const char* what) {
      if (size < resolved)
        refuse(std::string(what) + " of " + brief(size) + " is below what a time of " + brief(std::max(now, end)) +
               " resolves, " + brief(resolved));
    };
    if (steps > 0) return resolve((end - now) / steps, "equal steps");
    resolve(initial > 0 ? initial : (end - now) / 100, "a first step");
    if (largest > 0) resolve(largest, "a largest step");
  }
  /// The least step that a run from `begin` takes: some digits of it must be left in the time at its end.
  Real resolution(Real begin) const {
    return 64 * std::numeric_limits<Real>::epsilon() * std::max(std::abs(begin), std::abs(end));
  }
};

/// Chooses step sizes: equal ones, or automatic ones by the count of iterations. Rejected steps are cut to a part and
/// the size recovers afterwards. Every stop is met exactly.
class StepControl {
 public:
  StepControl(const MarchOptions& options, Real begin) : options_(options), begin_(begin), time_(begin) {
    const Real span = options.end - begin;
    size_ = options.steps > 0 ? span / options.steps : options.initial > 0 ? options.initial : span / 100;
    if (options_.steps == 0 && options_.largest > 0) size_ = std::min(size_, options_.largest);
    smallest_ = smallest();
    std::sort(options_.stops.begin(), options_.stops.end());
  }

  bool finished() const { return time_ >= options_.end; }
  Real time() const { return time_; }
  bool too_small() const { return size_ < smallest_; }

  /// Where the next step ends.
  Real next() const {
    const Real wanted = time_ + size_;
    Real limit = options_.end;
    if (options_.steps > 0) limit = std::min(limit, grid(done_ + 1));
    for (const Real stop : options_.stops)
      if (stop > time_ + 1e-12 * std::max(std::abs(begin_), std::abs(options_.end))) {
        limit = std::min(limit, stop);
        break;
      }
    // A remainder that would leave a sliver is taken along or shared; equal steps that were cut share less of it.
    if (wanted >= limit - 1e-9 * size_) return limit;
    if (wanted > limit - (options_.steps == 0 ? 0.5 : 0.1) * size_) return time_ + 0.5 * (limit - time_);
    return wanted;
  }

  /// Takes a converged step that ends at `time`; `error` is its local error over the time tolerance, and `excess` the
  /// largest of the estimates that go with the step's size over its tolerance; 0 without them.
  void accept(Real time, Index iterations, Real error = 0, Real excess = 0) {
    const Real taken = time - time_;
    time_ = time;
    if (options_.steps > 0) {
      const Real equal = (options_.end - begin_) / options_.steps;
      if (time_ >= grid(done_ + 1) - 1e-9 * equal) {
        ++done_;
        size_ = equal;
        wait_ = 0;
      } else if (wait_ > 0) {
        --wait_;
      } else {
        size_ = std::min(1.5 * size_, equal);  // a cut of any depth is made up for in some steps
      }
      return;
    }
    const Real before = size_;
    Real factor = std::clamp(std::sqrt(Real(options_.target_iterations) / std::max<Index>(iterations, 1)), 0.5, 1.5);
    // Where a smaller step did not take fewer iterations, still smaller ones are no use.
    if (factor >= 1) last_shrunk_ = 0;
    if (factor < 1 && last_shrunk_ > 0 && iterations >= last_shrunk_) factor = 1;
    if (factor < 1) last_shrunk_ = iterations;
    // A step shortened to meet a stop says nothing against the size, unless it was hard even so.
    size_ = factor < 1 ? std::min(size_, taken) * factor : std::max(size_, taken * factor);
    if (error > 0) size_ = std::min(size_, taken * error_factor(error));
    // A first contact lags wholly at any size, so one step says little.
    if (excess > 0) size_ = std::min(size_, taken * std::clamp(1 / excess, 0.5, 2.0));
    if (options_.largest > 0) size_ = std::min(size_, options_.largest);
    // What a step that converged wishes for is no reason to give up the next.
    size_ = std::max(size_, std::min(before, smallest_));
  }

  /// Gives up a step that was to end at `time` and did not converge.
  void reject(Real time) {
    size_ = 0.4 * (time - time_);
    wait_ = 1;  // the next step is as long, for one that converges says little
  }
  /// Gives up one that converged with too large an error.
  void reject(Real time, Real error) { size_ = (time - time_) * error_factor(error); }

  /// Where the run is. Of the options, equal steps must be the same; automatic ones may go on to another end.
  void serialize(Archive& archive) {
    archive.check_equal("choice of steps",
                        options_.steps > 0 ? std::to_string(options_.steps) + " equal steps" : "automatic");
    if (options_.steps > 0) archive.check_equal("end", round_trip(options_.end));
    archive("run, begin", begin_);
    archive("run, time", time_);
    archive("run, step size", size_);
    archive("run, steps of the grid", done_);
    archive("run, iterations at the last cut", last_shrunk_);
    archive("run, steps before the size grows", wait_);
    if (archive.loading()) smallest_ = smallest();
  }

 private:
  // Never less than what the time resolves: a step would end where it began.
  Real smallest() const {
    const Real asked = options_.smallest > 0 ? options_.smallest : 1e-9 * (options_.end - begin_);
    return std::max(asked, options_.resolution(begin_));
  }
  // The error goes with the cube of the size; a part is kept in reserve.
  static Real error_factor(Real error) { return std::clamp(0.9 / std::cbrt(error), 0.2, 2.0); }
  Real grid(Index k) const {
    return k >= options_.steps ? options_.end : begin_ + (options_.end - begin_) * k / options_.steps;
  }

  MarchOptions options_;
  Real begin_, time_, size_ = 0, smallest_ = 0;
  Index done_ = 0;
  Index wait_ = 0;         // of equal steps that were cut: converged ones before the size grows
  Index last_shrunk_ = 0;  // iterations of the step after which the size was last lowered for their sake; 0: it was not
};

}  // namespace stickslip
