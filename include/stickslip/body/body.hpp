// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/history.hpp>
#include <stickslip/dofs/condensed_unknowns.hpp>
#include <stickslip/dofs/evaluation.hpp>
#include <stickslip/dofs/sparse_matrix.hpp>
#include <stickslip/mesh/mesh.hpp>
#include <stickslip/mesh/sound.hpp>
#include <stickslip/policy/model.hpp>
#include <stickslip/tensor/products.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace stickslip {

/// The term of a deformable body: its stencils are the cells' nodes, its kernel is the element, its history the
/// material's memory at the quadrature points.
template <class Kinematics_, class Element_, class Material_, Symmetry storage_>
class BodyOf {
 public:
  using Kinematics = Kinematics_;
  using Element = Element_;
  using Material = Material_;
  using TensorPattern = typename Kinematics::TensorPattern;
  using MeshType = Mesh<Kinematics::dim, Element::nodes>;
  using State = typename Material::template State<Real, TensorPattern>;
  static constexpr int dim = Kinematics::dim;
  static constexpr int dofs = Element::nodes * dim;
  static constexpr Symmetry storage = storage_;
  using Matrix = SparseMatrix<storage>;

  /// `first_node` and `first_cell` are its numbers in the problem. Throws std::invalid_argument, naming the fault.
  [[gnu::cold]] BodyOf(MeshType mesh, const Kinematics& kinematics, const Material& material, std::string name = {},
                       Index first_node = 0, Index first_cell = 0)
      : mesh_(std::move(mesh)),
        name_(std::move(name)),
        first_node_(first_node),
        first_cell_(first_cell),
        extent_(mesh_.extent()),
        kinematics_(kinematics),
        material_(material) {
    if (mesh_.cells.empty()) throw std::invalid_argument("body: the mesh has no cells");
    require_sound(mesh_);
    geometry_.reserve(mesh_.cells.size());
    for (Index e = 0; e < mesh_.cell_count(); ++e) geometry_.push_back(cell_geometry(e));
    memory_ = Memory(mesh_.cells.size());
    condensed_ = Condensed(mesh_.cells.size());
  }

  const MeshType& mesh() const { return mesh_; }
  const std::string& name() const { return name_; }
  /// Number in the problem of the mesh's first node and cell.
  Index first_node() const { return first_node_; }
  Index first_cell() const { return first_cell_; }
  const Kinematics& kinematics() const { return kinematics_; }
  /// Largest reference coordinate [length].
  Real extent() const { return extent_; }
  const Material& material() const { return material_; }

  /// Nodal components of a cell, in the order of its element vectors.
  std::array<Index, static_cast<std::size_t>(dofs)> components(Index cell) const {
    std::array<Index, static_cast<std::size_t>(dofs)> c;
    for (std::size_t a = 0; a < static_cast<std::size_t>(Element::nodes); ++a)
      for (std::size_t i = 0; i < static_cast<std::size_t>(dim); ++i)
        c[a * dim + i] = (first_node_ + mesh_.cells[static_cast<std::size_t>(cell)][a]) * dim + static_cast<Index>(i);
    return c;
  }

  /// Reference coordinates of a cell's nodes, one row a node [length].
  Mat<Real, Element::nodes, dim> coordinates(Index cell) const {
    Mat<Real, Element::nodes, dim> X;
    for (int a = 0; a < Element::nodes; ++a) {
      const Index n = mesh_.cells[static_cast<std::size_t>(cell)][static_cast<std::size_t>(a)];
      for (int i = 0; i < dim; ++i) X(a, i) = mesh_.nodes[static_cast<std::size_t>(n)][i];
    }
    return X;
  }

  /// Couples the components of every cell.
  void couple(SparsityPattern& pattern) const {
    for (Index e = 0; e < mesh_.cell_count(); ++e) pattern.couple(components(e));
  }
  /// Makes the scatter maps into a matrix whose pattern stands.
  void connect(const IndexMap& equations, const Matrix& matrix) {
    slots_.clear();
    slots_.reserve(mesh_.cells.size());
    for (Index e = 0; e < mesh_.cell_count(); ++e) slots_.push_back(matrix.map(equations, components(e)));
  }

  /// Begins an iteration: the condensed unknowns' values of the converged state become unknowns of their own.
  void begin_iteration() {
    condensed_.begin();
    iterated_ = true;
  }
  /// Adds `share` of the last converged increment to the condensed unknowns, in an iteration that begins with
  /// displacements extrapolated in this way. A single dilatation follows from the displacements at once and goes along
  /// only on a `smooth` path.
  void extrapolate(Real share, bool smooth) {
    if (smooth || condensed_unknowns < Element >> 1) condensed_.extrapolate(share);
  }
  /// Predicts the condensed unknowns after the change du of the displacements, with a fraction of their constraint
  /// residuals closed.
  void predict(const Field& du, Real fraction) {
    if constexpr (condensed)
      for (Index e = 0; e < mesh_.cell_count(); ++e)
        condensed_.predict(static_cast<std::size_t>(e), gather(du, e), fraction);
  }
  void set_step(Real length) { condensed_.set_step(length); }
  Real constraint_merit() const { return condensed_.constraint_merit(); }

  /// Adds internal forces and their tangent.
  template <class Evaluation>
  Failure evaluate(const Evaluation& ev, Field& forces) {
    for (Index e = 0; e < mesh_.cell_count(); ++e) {
      const auto k = static_cast<std::size_t>(e);
      const Relation relation = ev.constraint_force ? Relation::open : Relation::closed;
      const FailureCause cause = evaluate_cell(k, gather(ev.u, e), ev.dt, relation, ev.want);
      if (cause != FailureCause::none) return {cause, {Location::Kind::element, first_cell_ + e}};
      if (ev.driven) {
        const Vec<Real, dofs> increment = gather(*ev.driven, e);
        if (contraction(increment, increment) != 0) add(result_.residual, product(result_.tangent, increment));
      }
      if (!std::isfinite(result_.residual.sum()) ||
          (ev.want != Want::residual && !std::isfinite(result_.tangent.sum())))
        return {FailureCause::not_finite, {Location::Kind::element, first_cell_ + e}};
      scatter(result_.residual, e, forces);
      if constexpr (condensed)
        if (ev.constraint_force) scatter(condensed_[k].force, e, *ev.constraint_force);
      if (ev.want != Want::residual) ev.matrix.add(slots_[k], result_.tangent);
      memory_.set_trial(k, result_.states);
    }
    return {};
  }

  /// Makes the memory of the last evaluation the converged one.
  void commit() {
    memory_.commit();
    condensed_.commit();
    iterated_ = false;
  }

  /// Calls visit(cell, point, F, state, weight) for the converged memory: F as the material sees it, weight the
  /// reference volume.
  template <class Visit>
  void visit_points(const Field& u, Visit&& visit) const {
    for (Index e = 0; e < mesh_.cell_count(); ++e) {
      const auto& geometry = geometry_[static_cast<std::size_t>(e)];
      const auto F = deformation(geometry, gather(u, e), static_cast<std::size_t>(e));
      const auto& states = memory_.converged(static_cast<std::size_t>(e));
      for (std::size_t p = 0; p < F.size(); ++p) visit(e, static_cast<int>(p), F[p], states[p], geometry[p].weight);
    }
  }

  /// The converged memory.
  void serialize(Archive& archive) {
    const std::string at = name_.empty() ? "body" : "body " + name_;
    memory_.serialize(archive, at + ", material memory");
    condensed_.serialize(archive, at + ", condensed unknowns");
  }

  /// Geometry of the quadrature points of a cell.
  const auto& geometry(Index cell) const { return geometry_[static_cast<std::size_t>(cell)]; }
  /// Where a cell's tangent is stored in the matrix.
  const auto& slots(Index cell) const { return slots_[static_cast<std::size_t>(cell)]; }

  /// Bytes of material memory a quadrature point keeps for one state (there are two: converged and trial).
  static constexpr std::size_t bytes_per_point = std::is_empty_v<State> ? 0 : sizeof(State);

 private:
  static constexpr bool condensed = condensed_unknowns<Element> > 0;
  using Condensed = CondensedUnknowns<dofs, condensed_unknowns<Element>>;
  using Memory = History<std::array<State, Element::points>, !std::is_empty_v<State>>;
  using Geometry = typename Element::template Geometry<Kinematics>;

  FailureCause evaluate_cell(std::size_t k, const Vec<Real, dofs>& local, Real dt, [[maybe_unused]] Relation relation,
                             Want want) {
    const auto& states = memory_.converged(k);
    if constexpr (condensed) {
      // An iteration's values have more digits than those of the displacements, and are kept.
      if (relation == Relation::closed && iterated_) {
        auto apart = condensed_[k];
        apart.value = condensed_.converged(k);
        return evaluate_element<Element>(geometry_[k], material_, local, states, dt, result_, want, apart, relation);
      }
      if (relation == Relation::closed) condensed_.begin(k);
      return evaluate_element<Element>(geometry_[k], material_, local, states, dt, result_, want, condensed_[k],
                                       relation);
    } else
      return evaluate_element<Element>(geometry_[k], material_, local, states, dt, result_, want);
  }

  auto deformation(const Geometry& geometry, const Vec<Real, dofs>& local, [[maybe_unused]] std::size_t k) const {
    if constexpr (condensed)
      return Element::deformation(geometry, local, condensed_.converged(k));
    else
      return Element::deformation(geometry, local);
  }

  Geometry cell_geometry(Index e) const {
    const Geometry geometry = geometry_of<Element>(kinematics_, coordinates(e));
    for (std::size_t p = 0; p < static_cast<std::size_t>(Element::points); ++p) {
      if (!(geometry[p].weight > 0) || !std::isfinite(geometry[p].weight))
        throw std::invalid_argument(
            "body: cell " + std::to_string(e) + " has no positive volume; its nodes must run counter-clockwise, " +
            (dim == 2 ? "and in axisymmetry at positive radius" : "seen from above, the lower face before the upper"));
    }
    return geometry;
  }

  Vec<Real, dofs> gather(const Field& field, Index e) const {
    Vec<Real, dofs> local;
    const auto& cell = mesh_.cells[static_cast<std::size_t>(e)];
    const Real* own = field.data() + first_node_ * dim;
    for (int a = 0; a < Element::nodes; ++a)
      for (int i = 0; i < dim; ++i) local[a * dim + i] = own[cell[static_cast<std::size_t>(a)] * dim + i];
    return local;
  }
  void scatter(const Vec<Real, dofs>& local, Index e, Field& field) const {
    const auto& cell = mesh_.cells[static_cast<std::size_t>(e)];
    Real* own = field.data() + first_node_ * dim;
    for (int a = 0; a < Element::nodes; ++a)
      for (int i = 0; i < dim; ++i) own[cell[static_cast<std::size_t>(a)] * dim + i] += local[a * dim + i];
  }

  MeshType mesh_;
  std::string name_;
  Index first_node_, first_cell_;
  Real extent_;
  [[no_unique_address]] Kinematics kinematics_;
  Material material_;
  std::vector<Geometry> geometry_;
  [[no_unique_address]] Memory memory_;
  [[no_unique_address]] Condensed condensed_;
  bool iterated_ = false;  // since the last commit
  std::vector<std::array<Index, static_cast<std::size_t>(Matrix::block_entries(dofs))>> slots_;
  ElementResult<Real, dofs, Element::points, State> result_;
};

}  // namespace stickslip
