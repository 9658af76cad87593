// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "axes.hpp"

#include <stickslip/linear_solver/banded.hpp>
#include <stickslip/linear_solver/bicgstab.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>
#include <stickslip/linear_solver/mumps.hpp>
#include <stickslip/linear_solver/umfpack.hpp>

namespace typed {

template <>
struct SolverType<eigen_lu> {
  using type = EigenLu;
};
template <>
struct SolverType<umfpack> {
  using type = Umfpack;
};
template <>
struct SolverType<banded_lu> {
  using type = BandedLu;
};
template <>
struct SolverType<mumps_lu> {
  using type = MumpsLu;
};
template <>
struct SolverType<bicgstab> {
  using type = Bicgstab;
};

static_assert(is_as_declared<EigenLu, Symmetry::general>);
static_assert(is_as_declared<Umfpack, Symmetry::general>);
static_assert(is_as_declared<BandedLu, Symmetry::general>);
static_assert(is_as_declared<MumpsLu, Symmetry::general>);
static_assert(is_as_declared<Bicgstab, Symmetry::general>);

}  // namespace typed
