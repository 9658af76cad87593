// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "axes.hpp"

#include <stickslip/linear_solver/banded.hpp>
#include <stickslip/linear_solver/cholmod.hpp>
#include <stickslip/linear_solver/conjugate_gradients.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/mumps.hpp>

namespace typed {

template <>
struct SolverType<eigen_ldlt> {
  using type = EigenLdlt;
};
template <>
struct SolverType<cholmod> {
  using type = Cholmod;
};
template <>
struct SolverType<banded_cholesky> {
  using type = BandedCholesky;
};
template <>
struct SolverType<mumps_ldlt> {
  using type = MumpsLdlt;
};
template <>
struct SolverType<conjugate_gradients> {
  using type = ConjugateGradients;
};

static_assert(is_as_declared<EigenLdlt, Symmetry::symmetric>);
static_assert(is_as_declared<Cholmod, Symmetry::symmetric>);
static_assert(is_as_declared<BandedCholesky, Symmetry::symmetric>);
static_assert(is_as_declared<MumpsLdlt, Symmetry::symmetric>);
static_assert(is_as_declared<ConjugateGradients, Symmetry::symmetric>);

}  // namespace typed
