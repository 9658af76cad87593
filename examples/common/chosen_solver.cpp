// SPDX-License-Identifier: BSL-1.0
#include "chosen_solver.hpp"

#include <stickslip/linear_solver/banded.hpp>
#include <stickslip/linear_solver/cholmod.hpp>
#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/linear_solver/eigen_direct.hpp>
#include <stickslip/linear_solver/eigen_iterative.hpp>
#include <stickslip/linear_solver/mumps.hpp>
#include <stickslip/linear_solver/umfpack.hpp>

#include <stdexcept>

namespace examples {

namespace {

using stickslip::Symmetry;

template <class Solver>
class Wrapped : public AnySolver {
 public:
  void analyze(const stickslip::SparseView& pattern) override { solver_.analyze(pattern); }
  stickslip::Factorization factorize(const stickslip::SparseView& matrix) override { return solver_.factorize(matrix); }
  bool solve(const double* right_hand_side, double* solution) override {
    return solver_.solve(right_hand_side, solution);
  }
  stickslip::Index inner_iterations() const override {
    if constexpr (requires { solver_.inner_iterations(); }) return solver_.inner_iterations();
    return 0;
  }
  std::size_t factor_bytes() const override {
    if constexpr (requires { solver_.factor_bytes(); }) return solver_.factor_bytes();
    return 0;
  }
  void serialize([[maybe_unused]] stickslip::Archive& archive) override {
    if constexpr (requires { solver_.serialize(archive); }) solver_.serialize(archive);
  }

 private:
  Solver solver_;
};

template <class Solver>
std::unique_ptr<AnySolver> make(Symmetry storage) {
  if (Solver::storage != storage) return nullptr;
  return std::make_unique<Wrapped<Solver>>();
}

template <class Family>
std::unique_ptr<AnySolver> make_of(Symmetry storage) {
  if (storage == Symmetry::symmetric) return make<typename Family::template For<Symmetry::symmetric>>(storage);
  return make<typename Family::template For<Symmetry::general>>(storage);
}

}  // namespace

std::unique_ptr<AnySolver> make_solver(const std::string& name, Symmetry storage) {
  using namespace stickslip;
  std::unique_ptr<AnySolver> solver;
  if (name == "cholmod") solver = make<Cholmod>(storage);
  if (name == "umfpack") solver = make<Umfpack>(storage);
  if (name == "eigen-ldlt") solver = make<EigenLdlt>(storage);
  if (name == "eigen-lu") solver = make<EigenLu>(storage);
  if (name == "conjugate-gradients") solver = make<ConjugateGradients>(storage);
  if (name == "bicgstab") solver = make<Bicgstab>(storage);
  if (name == "mumps") solver = make_of<Mumps>(storage);
  if (name == "banded") solver = make_of<Banded>(storage);
  if (name == "corrected-banded") solver = make<Corrected<BandedCholesky>>(storage);
  if (name == "corrected-cholmod") solver = make<Corrected<Cholmod>>(storage);
  if (name == "corrected-eigen-ldlt") solver = make<Corrected<EigenLdlt>>(storage);
  if (!solver) throw std::invalid_argument("no solver \"" + name + "\" for matrices of this storage");
  return solver;
}

}  // namespace examples
