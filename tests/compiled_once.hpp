// SPDX-License-Identifier: BSL-1.0
#pragma once

// What of Eigen nearly every test uses and takes a fifth of its compile time: compiled once, in compiled_once.cpp.
#include <stickslip/linear_solver/eigen_map.hpp>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

extern template class Eigen::SimplicialLDLT<stickslip::EigenMatrix, Eigen::Lower>;
extern template class Eigen::SimplicialCholeskyBase<Eigen::SimplicialLDLT<stickslip::EigenMatrix, Eigen::Lower>>;
extern template class Eigen::SparseLU<stickslip::EigenMatrix, Eigen::COLAMDOrdering<stickslip::Index>>;
