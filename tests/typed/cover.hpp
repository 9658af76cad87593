// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "axes.hpp"

namespace typed {

/// The models that run. Every two choices that can stand in one model do so in one of these, of the six solvers of
/// Eigen, SuiteSparse and LAPACK; product.cpp holds them against the product and names pairs that are missing, for
/// which a row is to be added. The laws of hardening count as choices of their own. MUMPS and the iterative solvers run
/// but the models that all other solvers run too; their scenes are in tests/physics/solvers*.cpp.
constexpr auto cover = std::to_array<Row>({
    {plane, mean, j2_voce, coulomb, last, penalty, still, eigen_ldlt},
    {plane, mean, neo_hookean, capped, iterated, penalty, moving, eigen_ldlt},
    {plane, mean, j2_perfect, tresca, last, penalty, still, eigen_ldlt},
    {plane, mean, j2_swift, smooth, current, augmented, moving, eigen_ldlt},
    {ring, mean, hencky, smooth, current, free_, still, eigen_ldlt},
    {ring, bends, j2_linear, stribeck, last, penalty, still, eigen_ldlt},
    {ring, mean, j2_linear, smooth, current, penalty, still, eigen_ldlt},
    {space, mean, hencky, weakening, iterated, augmented, moving, eigen_ldlt},
    {space, full, j2_linear, by_pair, ahead, augmented, still, eigen_ldlt},
    {space, bends, neo_hookean, anisotropic, ahead, penalty, moving, eigen_ldlt},
    {plane, mean, j2_voce, coulomb, last, penalty, still, eigen_lu},
    {plane, full, hencky, capped, ahead, penalty, still, eigen_lu},
    {plane, full, j2_perfect, coulomb, iterated, augmented, still, eigen_lu},
    {ring, full, neo_hookean, coulomb, current, augmented, still, eigen_lu},
    {ring, bends, hypo_linear, tresca, iterated, penalty, still, eigen_lu},
    {ring, full, hypo_swift, weakening, last, penalty, moving, eigen_lu},
    {ring, mean, j2_perfect, by_pair, last, penalty, still, eigen_lu},
    {ring, full, j2_voce, stribeck, last, penalty, still, eigen_lu},
    {space, mean, hypo_perfect, smooth, current, free_, still, eigen_lu},
    {space, full, hypo_linear, anisotropic, current, penalty, moving, eigen_lu},
    {plane, mean, j2_voce, coulomb, last, penalty, still, cholmod},
    {plane, mean, j2_swift, tresca, current, penalty, moving, cholmod},
    {plane, bends, hencky, coulomb, iterated, augmented, still, cholmod},
    {plane, mean, neo_hookean, weakening, iterated, augmented, still, cholmod},
    {ring, full, j2_perfect, capped, last, augmented, moving, cholmod},
    {ring, mean, j2_voce, smooth, current, free_, moving, cholmod},
    {ring, mean, j2_linear, weakening, ahead, penalty, still, cholmod},
    {space, mean, neo_hookean, by_pair, last, penalty, moving, cholmod},
    {space, mean, hencky, stribeck, last, augmented, still, cholmod},
    {space, full, j2_voce, anisotropic, last, augmented, still, cholmod},
    {plane, mean, j2_voce, coulomb, last, penalty, still, umfpack},
    {plane, bends, hypo_perfect, weakening, ahead, penalty, still, umfpack},
    {plane, mean, hypo_swift, by_pair, iterated, augmented, still, umfpack},
    {ring, full, neo_hookean, coulomb, current, augmented, still, umfpack},
    {ring, bends, hypo_swift, smooth, current, free_, moving, umfpack},
    {ring, full, neo_hookean, stribeck, current, penalty, still, umfpack},
    {ring, mean, j2_swift, capped, iterated, augmented, still, umfpack},
    {space, full, hypo_voce, tresca, iterated, augmented, moving, umfpack},
    {space, mean, hypo_linear, coulomb, ahead, penalty, moving, umfpack},
    {space, full, hencky, anisotropic, last, penalty, still, umfpack},
    {plane, mean, j2_voce, coulomb, last, penalty, still, banded_cholesky},
    {plane, full, j2_linear, smooth, current, free_, moving, banded_cholesky},
    {plane, mean, j2_swift, stribeck, ahead, augmented, still, banded_cholesky},
    {plane, bends, j2_voce, capped, ahead, augmented, moving, banded_cholesky},
    {plane, full, j2_voce, by_pair, last, penalty, still, banded_cholesky},
    {ring, full, neo_hookean, tresca, ahead, augmented, moving, banded_cholesky},
    {ring, mean, hencky, weakening, iterated, penalty, still, banded_cholesky},
    {space, mean, j2_perfect, anisotropic, iterated, augmented, still, banded_cholesky},
    {plane, mean, j2_voce, coulomb, last, penalty, still, banded_lu},
    {plane, mean, hencky, tresca, iterated, augmented, still, banded_lu},
    {ring, full, neo_hookean, coulomb, current, augmented, still, banded_lu},
    {ring, full, hypo_perfect, stribeck, iterated, penalty, moving, banded_lu},
    {ring, mean, j2_voce, weakening, current, augmented, moving, banded_lu},
    {ring, bends, hencky, by_pair, current, augmented, still, banded_lu},
    {ring, mean, neo_hookean, smooth, current, free_, still, banded_lu},
    {ring, full, hypo_swift, coulomb, current, penalty, still, banded_lu},
    {space, full, hypo_swift, anisotropic, ahead, penalty, moving, banded_lu},
    {space, full, hypo_linear, capped, current, augmented, moving, banded_lu},
    {plane, mean, j2_voce, coulomb, last, penalty, still, mumps_ldlt},
    {plane, mean, j2_voce, coulomb, last, penalty, still, mumps_lu},
    {plane, mean, j2_voce, coulomb, last, penalty, still, conjugate_gradients},
    {plane, mean, j2_voce, coulomb, last, penalty, still, bicgstab},
    {ring, full, neo_hookean, coulomb, current, augmented, still, mumps_lu},
    {ring, full, neo_hookean, coulomb, current, augmented, still, bicgstab},
});

}  // namespace typed
