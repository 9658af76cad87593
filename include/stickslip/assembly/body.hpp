// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/sparse_matrix.hpp>
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

/// Memory of all quadrature points; no byte where the material remembers nothing.
template <class State, std::size_t points>
class PointMemory {
 public:
  static constexpr bool stored = !std::is_empty_v<State>;
  using Cell = std::array<State, points>;

  void resize(std::size_t cells) {
    if constexpr (stored) cells_.assign(cells, Cell{});
  }
  decltype(auto) of(Index cell) const {
    if constexpr (stored)
      return static_cast<const Cell&>(cells_[static_cast<std::size_t>(cell)]);
    else
      return Cell{};
  }
  void store(Index cell, const Cell& states) {
    if constexpr (stored) cells_[static_cast<std::size_t>(cell)] = states;
  }
  void serialize(Archive& archive, const std::string& name) {
    if constexpr (stored) archive(name, cells_);
  }

 private:
  [[no_unique_address]] Only<stored, std::vector<Cell>, PointMemory> cells_;
};

/// The deformable body: element geometry, material memory and the loop over elements.
template <class Kinematics_, class Element_, class Material_, Symmetry storage_>
class BodyOf {
 public:
  using Kinematics = Kinematics_;
  using Element = Element_;
  using Material = Material_;
  using Shape = typename Kinematics::Shape;
  using MeshType = Mesh<Kinematics::dim, Element::nodes>;
  using State = typename Material::template State<Real, Shape>;
  static constexpr int dim = Kinematics::dim;
  static constexpr int dofs = Element::nodes * dim;
  static constexpr Symmetry storage = storage_;
  using Matrix = SparseMatrix<storage>;

  BodyOf(MeshType mesh, const Kinematics& kinematics, const Material& material)
      : mesh_(std::move(mesh)), kinematics_(kinematics), material_(material) {
    if (mesh_.cells.empty()) throw std::invalid_argument("body: the mesh has no cells");
    require_sound(mesh_);
    geometry_.reserve(mesh_.cells.size());
    for (Index e = 0; e < mesh_.cell_count(); ++e) geometry_.push_back(cell_geometry(e));
    committed_.resize(mesh_.cells.size());
    trial_.resize(mesh_.cells.size());
    if constexpr (stiff) dilatations_ = StiffRelations<dofs>(mesh_.cells.size());
  }

  const MeshType& mesh() const { return mesh_; }
  const Kinematics& kinematics() const { return kinematics_; }
  const Material& material() const { return material_; }

  /// Nodal components of a cell, in the order of its element vectors.
  std::array<Index, static_cast<std::size_t>(dofs)> components(Index cell) const {
    std::array<Index, static_cast<std::size_t>(dofs)> c;
    for (std::size_t a = 0; a < static_cast<std::size_t>(Element::nodes); ++a)
      for (std::size_t i = 0; i < static_cast<std::size_t>(dim); ++i)
        c[a * dim + i] = mesh_.cells[static_cast<std::size_t>(cell)][a] * dim + static_cast<Index>(i);
    return c;
  }

  /// Couples the components of every cell.
  void couple(SparsityPattern& pattern) const {
    for (Index e = 0; e < mesh_.cell_count(); ++e) pattern.couple(components(e));
  }
  /// Makes the scatter maps into a matrix whose pattern stands.
  void connect(const Dofs& equations, const Matrix& matrix) {
    slots_.clear();
    slots_.reserve(mesh_.cells.size());
    for (Index e = 0; e < mesh_.cell_count(); ++e) slots_.push_back(matrix.map(equations, components(e)));
  }

  /// Begins an iteration: the stiff relations' values of the converged state become variables of their own.
  void begin_iteration() {
    if constexpr (stiff) dilatations_.begin();
  }
  /// Makes the variables follow the change du of the displacements, and close a share of their defects.
  void follow(const Field& du, Real closing) {
    if constexpr (stiff)
      for (Index e = 0; e < mesh_.cell_count(); ++e)
        dilatations_.follow(static_cast<std::size_t>(e), gather(du, e), closing);
  }
  void move(Real length) {
    if constexpr (stiff) dilatations_.move(length);
  }
  Real openness() const {
    if constexpr (stiff) return dilatations_.openness();
    return 0;
  }

  /// Adds internal forces and tangent at the nodal displacements u. With `driven`, a nodal field of increments still to
  /// come, the forces are those to first order after it. With `excess`, at the variables of the iteration, and it takes
  /// the forces that closing their defects adds.
  Trouble assemble(const Field& u, Real dt, const Field* driven, Field& forces, Field* excess, Matrix& matrix) {
    for (Index e = 0; e < mesh_.cell_count(); ++e) {
      const Vec<Real, dofs> local = gather(u, e);
      const Cause cause = evaluate(e, local, dt, excess != nullptr);
      if (cause != Cause::none) return {cause, {Place::Kind::element, e}};
      if (driven) {
        const Vec<Real, dofs> increment = gather(*driven, e);
        if (contraction(increment, increment) != 0) add(result_.residual, product(result_.tangent, increment));
      }
      if (!std::isfinite(result_.residual.sum()) || !std::isfinite(result_.tangent.sum()))
        return {Cause::not_finite, {Place::Kind::element, e}};
      scatter(result_.residual, e, forces);
      if constexpr (stiff)
        if (excess) scatter(dilatations_[static_cast<std::size_t>(e)].excess, e, *excess);
      matrix.add(slots_[static_cast<std::size_t>(e)], result_.tangent);
      trial_.store(e, result_.states);
    }
    return {};
  }

  /// Makes the memory of the last assembly the converged one.
  void commit() {
    std::swap(committed_, trial_);
    if constexpr (stiff) dilatations_.commit();
  }

  /// Calls visit(cell, point, F, state, weight) for the converged memory: F as the material sees it, weight the
  /// reference volume.
  template <class Visit>
  void visit_points(const Field& u, Visit&& visit) const {
    for (Index e = 0; e < mesh_.cell_count(); ++e) {
      const auto& geometry = geometry_[static_cast<std::size_t>(e)];
      const auto F = Element::deformation(geometry, gather(u, e));
      const auto& states = committed_.of(e);
      for (std::size_t p = 0; p < F.size(); ++p) visit(e, static_cast<int>(p), F[p], states[p], geometry[p].weight);
    }
  }

  /// The converged memory.
  void serialize(Archive& archive) {
    committed_.serialize(archive, "body, material memory");
    if constexpr (stiff) dilatations_.serialize(archive, "body, dilatations");
  }

  /// Geometry of the quadrature points of a cell.
  const auto& geometry(Index cell) const { return geometry_[static_cast<std::size_t>(cell)]; }
  /// Where a cell's tangent is stored in the matrix.
  const auto& slots(Index cell) const { return slots_[static_cast<std::size_t>(cell)]; }

  /// Bytes of material memory a quadrature point keeps for one state (there are two: converged and trial).
  static constexpr std::size_t bytes_per_point = PointMemory<State, Element::points>::stored ? sizeof(State) : 0;

 private:
  static constexpr bool stiff = has_stiff_relation<Element>;
  using Geometry = typename Element::template Geometry<Kinematics>;

  Cause evaluate(Index e, const Vec<Real, dofs>& local, Real dt, [[maybe_unused]] bool relaxed) {
    const auto& geometry = geometry_[static_cast<std::size_t>(e)];
    if constexpr (stiff)
      return Element::evaluate(geometry, material_, local, committed_.of(e), dt, result_,
                               relaxed ? &dilatations_[static_cast<std::size_t>(e)] : nullptr);
    else
      return Element::evaluate(geometry, material_, local, committed_.of(e), dt, result_);
  }

  Geometry cell_geometry(Index e) const {
    const auto& cell = mesh_.cells[static_cast<std::size_t>(e)];
    Mat<Real, Element::nodes, dim> X;
    for (int a = 0; a < Element::nodes; ++a) {
      const Index n = cell[static_cast<std::size_t>(a)];
      for (int i = 0; i < dim; ++i) X(a, i) = mesh_.nodes[static_cast<std::size_t>(n)][i];
    }
    Geometry geometry;
    const auto rule = Element::Cell::quadrature();
    for (std::size_t p = 0; p < rule.size(); ++p) {
      geometry[p] = point_geometry<Kinematics, typename Element::Cell>(kinematics_, X, rule[p].xi, rule[p].weight);
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
    for (int a = 0; a < Element::nodes; ++a)
      for (int i = 0; i < dim; ++i) local[a * dim + i] = field[cell[static_cast<std::size_t>(a)] * dim + i];
    return local;
  }
  void scatter(const Vec<Real, dofs>& local, Index e, Field& field) const {
    const auto& cell = mesh_.cells[static_cast<std::size_t>(e)];
    for (int a = 0; a < Element::nodes; ++a)
      for (int i = 0; i < dim; ++i) field[cell[static_cast<std::size_t>(a)] * dim + i] += local[a * dim + i];
  }

  MeshType mesh_;
  [[no_unique_address]] Kinematics kinematics_;
  Material material_;
  std::vector<Geometry> geometry_;
  PointMemory<State, Element::points> committed_, trial_;
  [[no_unique_address]] Only<stiff, StiffRelations<dofs>, Element> dilatations_;
  std::vector<std::array<Index, static_cast<std::size_t>(Matrix::block_entries(dofs))>> slots_;
  ElementResult<Real, dofs, Element::points, State> result_;
};

/// The body of a bundle; bundles that differ in contact, inertia or solver share it.
template <class Model>
using Body =
    BodyOf<typename Model::Kinematics, typename Model::Element, typename Model::Material, matrix_storage<Model>>;

}  // namespace stickslip
