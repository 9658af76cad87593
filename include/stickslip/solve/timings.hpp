// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <chrono>

namespace stickslip {

/// Wall time spent so far [s].
struct Timings {
  Real assembly = 0;       ///< body and scatter
  Real contact = 0;        ///< closest points, contact and friction
  Real factorization = 0;  ///< numeric and, once, symbolic
  Real solve = 0;          ///< forward and backward substitution
  Real estimates = 0;      ///< of the mesh's error
  Real update = 0;         ///< of stencils that change from step to step, and of the pattern then

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("assembly", self.assembly);
    visit("contact", self.contact);
    visit("factorization", self.factorization);
    visit("solve", self.solve);
    visit("estimates", self.estimates);
    visit("update", self.update);
  }
};

/// Adds the time of a scope to a counter.
class Stopwatch {
 public:
  explicit Stopwatch(Real& counter) : counter_(counter), begin_(std::chrono::steady_clock::now()) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { counter_ += std::chrono::duration<Real>(std::chrono::steady_clock::now() - begin_).count(); }

 private:
  Real& counter_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace stickslip
