// SPDX-License-Identifier: BSL-1.0
#pragma once

/// From names that a program's user gives to models that were put together at compile time, and a linear solver chosen
/// by its name behind virtual functions: one model for all solvers that take the same matrix, where a model each would
/// take long to compile. docs/policies.md, section By name. A program includes this header where it offers names; the
/// library itself has no use for it.

#include <stickslip/base/archive.hpp>
#include <stickslip/base/brief.hpp>
#include <stickslip/policy/model.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace stickslip::run_time {

/// A name that is not offered, or not with the others; one sentence with the names that are.
struct NotOffered : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

namespace detail {
[[noreturn]] inline void refuse(const std::string& what, std::string_view name, const std::vector<std::string>& names) {
  throw NotOffered(what + ": \"" + std::string(name) + "\" is not offered; these are: " + listed(names));
}
}  // namespace detail

/// A policy, or a whole model, under its name.
template <class Policy_>
struct Named {
  using Policy = Policy_;
  const char* name;
};

/// A list of them: `constexpr Choices laws{Named<Coulomb>{"coulomb"}, ...};`
template <class... Policies>
struct Choices {
  static_assert(sizeof...(Policies) > 0);
  explicit constexpr Choices(Named<Policies>... n) : names{n.name...} {}
  const char* names[sizeof...(Policies)];

  std::vector<std::string> list() const { return {std::begin(names), std::end(names)}; }
  /// Calls visit(Named) for each.
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::size_t i = 0;
    (visit(Named<Policies>{names[i++]}), ...);
  }
  /// Returns visit(Named) for the one of that name. Throws NotOffered if there is none, with `what` it should be of.
  template <std::size_t i = 0, class Visit>
  decltype(auto) find(const std::string& what, std::string_view name, Visit&& visit) const {
    using Policy = std::tuple_element_t<i, std::tuple<Policies...>>;
    if (name == names[i]) return visit(Named<Policy>{names[i]});
    if constexpr (i + 1 < sizeof...(Policies))
      return this->template find<i + 1>(what, name, std::forward<Visit>(visit));
    else
      detail::refuse(what, name, list());
  }
};

/// A solver behind virtual functions. The calls, a few for each factorisation, cost nothing that can be measured.
class AnySolver {
 public:
  AnySolver() = default;
  AnySolver(const AnySolver&) = delete;
  AnySolver& operator=(const AnySolver&) = delete;
  virtual ~AnySolver() = default;
  virtual void analyze(const SparseView& pattern) = 0;
  virtual Factorization factorize(const SparseView& matrix) = 0;
  virtual bool solve(const Real* right_hand_side, Real* solution) = 0;
  virtual Index inner_iterations() const = 0;
  virtual std::size_t factor_bytes() const = 0;
  virtual void serialize(Archive& archive) = 0;
};

namespace detail {
template <class Solver>
class Wrapped final : public AnySolver {
 public:
  explicit Wrapped(const SolverParameters<Solver>& parameters) : solver_(make_solver<Solver>(parameters)) {}
  void analyze(const SparseView& pattern) override { solver_.analyze(pattern); }
  Factorization factorize(const SparseView& matrix) override { return solver_.factorize(matrix); }
  bool solve(const Real* right_hand_side, Real* solution) override { return solver_.solve(right_hand_side, solution); }
  Index inner_iterations() const override {
    if constexpr (requires { solver_.inner_iterations(); }) return static_cast<Index>(solver_.inner_iterations());
    return 0;
  }
  std::size_t factor_bytes() const override {
    if constexpr (requires { solver_.factor_bytes(); }) return static_cast<std::size_t>(solver_.factor_bytes());
    return 0;
  }
  void serialize([[maybe_unused]] Archive& archive) override {
    if constexpr (requires { solver_.serialize(archive); }) solver_.serialize(archive);
  }

 private:
  Solver solver_;
};
}  // namespace detail

/// The matrix that a solver is handed.
enum class Takes {
  triangle,    ///< lower triangle of a symmetric system
  full,        ///< full matrix of any system
  corrections  ///< lower triangle of a general system, and the couplings of sliding nodes apart
};

/// That of a solver.
template <LinearSolverPolicy Solver>
inline constexpr Takes takes_of = accepts_couplings<Solver>                ? Takes::corrections
                                  : Solver::storage == Symmetry::symmetric ? Takes::triangle
                                                                           : Takes::full;

/// The linear solvers that a program offers, by name.
class SolverList {
 public:
  /// Adds a solver; each that is made has these parameters.
  template <LinearSolverPolicy Solver>
  SolverList& add(const std::string& name, const SolverParameters<Solver>& parameters = {}) {
    put<Solver>(entry(name), parameters);
    return *this;
  }
  /// Adds the members of a family under one name.
  template <LinearSolverFamily Family>
  SolverList& add(const std::string& name) {
    Entry& e = entry(name);
    put<typename Family::template For<Symmetry::general>>(e, {});
    put<typename Family::template For<Symmetry::symmetric>>(e, {});
    return *this;
  }
  /// Those of these names alone, in their order.
  SolverList only(std::initializer_list<std::string> names) const {
    SolverList some;
    for (const std::string& name : names) some.entries_.push_back(find(name));
    return some;
  }

  std::vector<std::string> names() const {
    return names_if([](const Entry&) { return true; });
  }
  /// Names of the solvers that take such a matrix.
  std::vector<std::string> names(Takes matrix) const {
    return names_if([&](const Entry& e) { return e.takes(matrix); });
  }
  /// Whether the solver of that name takes such a matrix. Throws NotOffered if there is none.
  bool takes(std::string_view name, Takes matrix) const { return find(name).takes(matrix); }
  /// A new solver. Throws NotOffered if none of that name takes such a matrix.
  std::unique_ptr<AnySolver> make(std::string_view name, Takes matrix) const {
    const Entry& e = find(name);
    if (!e.takes(matrix))
      throw NotOffered("linear solver: \"" + std::string(name) + "\" does not take the matrix of this model; " +
                       "these do: " + listed(names(matrix)));
    return e.make[static_cast<std::size_t>(matrix)]();
  }

 private:
  struct Entry {
    std::string name;
    std::array<std::function<std::unique_ptr<AnySolver>()>, 3> make{};  // by Takes; empty: does not
    bool takes(Takes matrix) const { return static_cast<bool>(make[static_cast<std::size_t>(matrix)]); }
  };

  Entry& entry(const std::string& name) {
    for (const Entry& e : entries_)
      if (e.name == name) throw std::invalid_argument("linear solver: the name \"" + name + "\" is there twice");
    return entries_.emplace_back(Entry{name});
  }
  template <class Solver>
  static void put(Entry& e, const SolverParameters<Solver>& parameters) {
    e.make[static_cast<std::size_t>(takes_of<Solver>)] = [parameters] {
      return std::make_unique<detail::Wrapped<Solver>>(parameters);
    };
  }
  const Entry& find(std::string_view name) const {
    for (const Entry& e : entries_)
      if (e.name == name) return e;
    detail::refuse("linear solver", name, names());
  }
  template <class Predicate>
  std::vector<std::string> names_if(Predicate&& wanted) const {
    std::vector<std::string> found;
    for (const Entry& e : entries_)
      if (wanted(e)) found.push_back(e.name);
    return found;
  }

  std::vector<Entry> entries_;
};

/// What a solver by name is made from.
struct SolverName {
  std::string name;
};

/// A solver of those that `Offered` lists, a struct of the program with `static const SolverList& solvers()`. That may
/// be defined in another unit than the models, which alone includes the solvers. It tells no negative pivots and is not
/// asked for the condition of the matrix.
template <class Offered, Takes matrix>
class SolverByName {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = matrix == Takes::triangle ? Symmetry::symmetric : Symmetry::general;
  static constexpr Symmetry storage = matrix == Takes::full ? Symmetry::general : Symmetry::symmetric;
  static constexpr bool corrects = matrix == Takes::corrections;
  using Parameters = SolverName;

  explicit SolverByName(const Parameters& parameters)
      : name_(parameters.name), solver_(Offered::solvers().make(name_, matrix)) {}

  void analyze(const SparseView& pattern) { solver_->analyze(pattern); }
  Factorization factorize(const SparseView& m) { return solver_->factorize(m); }
  bool solve(const Real* right_hand_side, Real* solution) { return solver_->solve(right_hand_side, solution); }
  Index inner_iterations() const { return solver_->inner_iterations(); }
  std::size_t factor_bytes() const { return solver_->factor_bytes(); }
  void serialize(Archive& archive) {
    archive.check_equal("solver's name", name_);
    solver_->serialize(archive);
  }

 private:
  std::string name_;
  std::unique_ptr<AnySolver> solver_;
};

/// `Base` with another law of friction and another solver.
template <class Base, class Friction_, class Solver_>
struct With : Base {
  using Friction = Friction_;
  using LinearSolver = Solver_;
};

/// The models that are worth offering: every valid one, but for a symmetric system no full matrix and nothing to
/// correct.
template <class Model>
constexpr bool is_offered() {
  if constexpr (!valid_model<Model>)
    return false;
  else
    return system_symmetry<Model> == Symmetry::general ||
           (matrix_storage<Model> == Symmetry::symmetric && !accepts_couplings<SolverOf<Model>>);
}

namespace detail {
inline constexpr std::array matrices{Takes::triangle, Takes::full, Takes::corrections};

template <class Base, class Offered, class Friction, std::size_t k>
using ModelOf = With<Base, Friction, SolverByName<Offered, matrices[k]>>;

// The number of the first matrix with which a model of this friction is offered; that of all if there is none.
template <class Base, class Offered, class Friction, std::size_t k = 0>
constexpr std::size_t first_offered() {
  if constexpr (k == matrices.size())
    return k;
  else if constexpr (is_offered<ModelOf<Base, Offered, Friction, k>>())
    return k;
  else
    return first_offered<Base, Offered, Friction, k + 1>();
}

template <class Result, class Base, class Offered, class Friction, std::size_t k = 0, class Run>
Result with_solver(const char* friction, const std::string& solver, Run&& run);
}  // namespace detail

/// Names of the offered solvers that take the system of `Base` with a law of friction.
template <class Base, class Offered, class Friction>
std::vector<std::string> solvers_for() {
  std::array<bool, 3> taken{};
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    ((taken[k] = is_offered<detail::ModelOf<Base, Offered, Friction, k>>()), ...);
  }
  (std::make_index_sequence<3>());
  std::vector<std::string> found;
  const SolverList& solvers = Offered::solvers();
  for (const std::string& name : solvers.names()) {
    bool takes = false;
    for (std::size_t k = 0; k < 3; ++k) takes = takes || (taken[k] && solvers.takes(name, detail::matrices[k]));
    if (takes) found.push_back(name);
  }
  return found;
}

namespace detail {
template <class Result, class Base, class Offered, class Friction, std::size_t k, class Run>
Result with_solver(const char* friction, const std::string& solver, Run&& run) {
  if constexpr (k < matrices.size()) {
    using Model = ModelOf<Base, Offered, Friction, k>;
    if constexpr (is_offered<Model>())
      if (Offered::solvers().takes(solver, matrices[k])) return run.template operator()<Model>();
    return with_solver<Result, Base, Offered, Friction, k + 1>(friction, solver, std::forward<Run>(run));
  } else {
    (void)Offered::solvers().takes(solver, Takes::full);  // throws if there is no such solver at all
    const bool symmetric = is_offered<ModelOf<Base, Offered, Friction, 0>>();
    throw NotOffered("linear solver: \"" + solver + "\" takes " +
                     (symmetric ? "non-symmetric systems, and \"" : "symmetric systems only, and \"") + friction +
                     "\" makes a " + (symmetric ? "symmetric" : "non-symmetric") +
                     " one; these take it: " + listed(solvers_for<Base, Offered, Friction>()));
  }
}
}  // namespace detail

/// Calls run.template operator()<Model>() for the model of `Base` with the friction and the solver of these names, and
/// returns its result; the march of the model is given the solver's name again. Throws NotOffered for names that are
/// not in the lists, or do not go together.
template <class Base, class Offered, class... Frictions, class Run>
decltype(auto) dispatch(const Choices<Frictions...>& frictions, std::string_view friction, const std::string& solver,
                        Run&& run) {
  return frictions.find("friction", friction, [&]<class Friction>(Named<Friction> law) -> decltype(auto) {
    constexpr std::size_t first = detail::first_offered<Base, Offered, Friction>();
    static_assert(first < detail::matrices.size(),
                  "stickslip: a law of the list makes no valid model with the others of the model's choices.");
    using Result = decltype(run.template operator()<detail::ModelOf<Base, Offered, Friction, first>>());
    return detail::with_solver<Result, Base, Offered, Friction>(law.name, solver, run);
  });
}

}  // namespace stickslip::run_time
