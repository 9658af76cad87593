// SPDX-License-Identifier: BSL-1.0
#include "compiled_once.hpp"

template class Eigen::SimplicialLDLT<stickslip::EigenMatrix, Eigen::Lower>;
template class Eigen::SimplicialCholeskyBase<Eigen::SimplicialLDLT<stickslip::EigenMatrix, Eigen::Lower>>;
template class Eigen::SparseLU<stickslip::EigenMatrix, Eigen::COLAMDOrdering<stickslip::Index>>;
