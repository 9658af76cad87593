// SPDX-License-Identifier: BSL-1.0
// A table of hard cases: each prints one line and asserts its answer, or its clean refusal.
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/base/types.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace stability {

using namespace stickslip;
using V = Vec<Real, 2>;

/// What became of a case, and the judge of it: whatever does not hold makes it wrong.
class Case {
 public:
  explicit Case(std::string label) : label_(std::move(label)) {}

  /// Notes a claim that failed.
  void require(bool holds, const std::string& claim) {
    if (!holds) wrong_.push_back(claim);
  }
  /// |value - exact| <= tolerance |exact|; the largest such error of the case is printed.
  void near(Real value, Real exact, Real tolerance, const std::string& claim) {
    small(std::abs(value - exact) / (exact != 0 ? std::abs(exact) : 1), tolerance, claim);
  }
  /// An error that must not exceed its limit.
  void small(Real error, Real limit, const std::string& claim) {
    worst_ = std::max(worst_, std::isfinite(error) ? error : std::numeric_limits<Real>::infinity());
    if (!(error <= limit)) wrong_.push_back(claim + " (off by " + number(error) + ", allowed " + number(limit) + ")");
  }
  /// Runs a march to its end, counts its work, and demands that it complete.
  template <class March>
  void completes(March&& march) {
    runs(march);
    require(bool(march.outcome()), march.outcome().message());
  }
  /// Runs a march to its end, counts its work, and demands that it be refused for one of these causes.
  template <class March>
  void refuses(March&& march, std::vector<FailureCause> causes) {
    runs(march);
    refused_for(march.outcome().failure.cause, causes, march.outcome().message());
  }
  /// Counts the work of a march that has run.
  template <class March>
  void runs(March&& march) {
    for (const auto& step : march) balance_ = std::max(balance_, step.residual);
    counts(march.report().steps, march.report().iterations, march.report().rejected_steps);
  }
  void counts(Index steps, Index iterations, Index rejected) {
    steps_ += steps;
    iterations_ += iterations;
    rejected_ += rejected;
  }
  /// The error of a run's energy balance over its largest term.
  void energy_balance(Real error, Real limit) {
    balance_ = std::max(balance_, error);
    if (!(error <= limit))
      wrong_.push_back("energy is out of balance by " + number(error) + ", allowed " + number(limit));
  }
  /// Ends in a refusal that was asked for.
  void refused_for(FailureCause cause, const std::vector<FailureCause>& causes, const std::string& message) {
    refused_ = true;
    require(std::find(causes.begin(), causes.end(), cause) != causes.end(), message);
    cause_ = describe(cause);
  }
  /// The case ends in an input error that names `part`.
  template <class F>
  void complains(F&& f, const std::string& part) {
    refused_ = true;
    try {
      f();
      wrong_.push_back("no complaint about " + part);
    } catch (const std::invalid_argument& error) {
      cause_ = "input error";
      require(std::string(error.what()).find(part) != std::string::npos, "complaint: " + std::string(error.what()));
    }
  }
  void note(const std::string& text) { note_ += (note_.empty() ? "" : "; ") + text; }

  static std::string number(Real x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", x);
    return text;
  }

  const std::string& label() const { return label_; }
  const std::vector<std::string>& wrong() const { return wrong_; }
  bool refused() const { return refused_; }
  std::string outcome() const { return !wrong_.empty() ? "WRONG" : refused_ ? "refused: " + cause_ : "converged"; }
  Index steps() const { return steps_; }
  Index iterations() const { return iterations_; }
  Index rejected() const { return rejected_; }
  /// The worst error of the compared quantities.
  Real worst() const { return worst_; }
  /// The worst relative error of the energy balance, or residual over the force scale.
  Real balance() const { return balance_; }
  const std::string& noted() const { return note_; }

 private:
  std::string label_, cause_, note_;
  std::vector<std::string> wrong_;
  Index steps_ = 0, iterations_ = 0, rejected_ = 0;
  Real worst_ = 0, balance_ = 0;
  bool refused_ = false;
};

enum class Form { quick, full };  ///< in which forms of the suite a case runs: in both, or in the full one alone

struct Entry {
  std::string group, name, model, asserted;
  Form form;
  std::function<void(Case&)> run;
};
/// All cases, in the order of their registration within a source file.
std::vector<Entry>& entries();

/// Registers a case at namespace scope.
struct HardCase {
  HardCase(std::string group, std::string name, std::string model, std::string asserted, std::function<void(Case&)> run,
           Form form = Form::quick) {
    entries().push_back(
        {std::move(group), std::move(name), std::move(model), std::move(asserted), form, std::move(run)});
  }
};

}  // namespace stability
