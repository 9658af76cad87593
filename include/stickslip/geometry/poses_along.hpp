// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/pose.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stickslip::rigid {

/// Poses of a tool at times within a step (theory.md, section 4.7): five for a tool at rest or in straight translation;
/// for one that rotates or moves back and forth, enough to limit the rotation between neighbouring poses to `most`. The
/// times are at irrational fractions of the step, because equal intervals would miss whole turns.
template <int dim>
class PosesAlong {
 public:
  /// Largest rotation from one pose to the next [rad].
  static constexpr Real most = 0.1;

  struct At {
    Real share = 0;  ///< elapsed fraction of the step [-]
    Pose<dim> pose;
  };

  /// Reserves memory for the poses of a tool that does not rotate.
  PosesAlong() { poses_.reserve(5); }

  void take(const Motion<dim>& motion, Real begin, Real end) {
    begin_ = begin;
    end_ = end;
    resolved_ = true;
    poses_.clear();
    for (const Real share : {0.0, 0.2360679774997897, 0.5278640450004206, 0.7639320225002103, 1.0})
      poses_.push_back(at(motion, share));
    Real turn = 0, way = 0;
    bool rigid = true;
    for (std::size_t i = 1; i < poses_.size(); ++i) {
      turn = std::max(turn, angle(poses_[i - 1], poses_[i]));
      way += distance(poses_[i - 1], poses_[i]);
      rigid = rigid && poses_[i].pose.rigid() && poses_[i].pose.finite();
    }
    // Poses that are not rigid are reported by the contact.
    turns_ = rigid && (turn > 1e-12 || way > straight * distance(poses_.front(), poses_.back()));
    if (!turns_) return;
    const std::array<At, 5> coarse{poses_[0], poses_[1], poses_[2], poses_[3], poses_[4]};
    poses_.clear();
    poses_.push_back(coarse[0]);
    for (std::size_t i = 1; i < coarse.size(); ++i) refine(motion, coarse[i - 1], coarse[i], 1e-3 * way, 0);
  }

  /// Takes poses at equal intervals instead: a tool in translation may turn its normal under a slipping node.
  void divide(const Motion<dim>& motion, int parts) {
    poses_.clear();
    for (int i = 0; i <= parts; ++i) poses_.push_back(at(motion, Real(i) / parts));
  }

  /// Whether the poses are those of the step from `begin` to `end`.
  bool are_of(Real begin, Real end) const { return !poses_.empty() && begin == begin_ && end == end_; }
  Real end() const { return end_; }
  /// Whether the tool rotates or moves back and forth, so that the paths of its points are longer than their chords.
  bool turns() const { return turns_; }
  /// False if the motion needs more poses than the limit.
  bool resolved() const { return resolved_; }

  std::size_t size() const { return poses_.size(); }
  const At& operator[](std::size_t i) const { return poses_[i]; }

 private:
  static constexpr Real straight = 1.02;  // path length over chord [-]
  static constexpr int deepest = 6;
  static constexpr std::size_t largest = 4096;

  At at(const Motion<dim>& motion, Real share) const {
    return {share, motion.at(share < 1 ? begin_ + share * (end_ - begin_) : end_)};
  }
  // Rotation angle from a to b, at most pi [rad].
  static Real angle(const At& a, const At& b) {
    const Real sine = (b.pose.rotation - a.pose.rotation).norm() / std::sqrt(8.0);
    return 2 * std::asin(std::min(1.0, sine));
  }
  static Real distance(const At& a, const At& b) { return (b.pose.translation - a.pose.translation).norm(); }

  // Appends the poses after a up to b. Two intermediate poses test whether the motion from a to b is straight: their
  // fractions are irrational, so that no rotation rate escapes both. An excursion shorter than `finest` may escape.
  void refine(const Motion<dim>& motion, const At& a, const At& b, Real finest, int depth) {
    const Real length = b.share - a.share;
    const At c = at(motion, a.share + 0.3819660112501051 * length),
             d = at(motion, a.share + 0.6931471805599453 * length);
    const Real turn = angle(a, c) + angle(c, d) + angle(d, b), way = distance(a, c) + distance(c, d) + distance(d, b);
    const bool steady = turn - angle(a, b) <= 0.02 * turn + 1e-3 * most && way - distance(a, b) <= 0.02 * way + finest;
    if (turn <= most && steady) {
      poses_.push_back(b);
      return;
    }
    const bool finite = std::isfinite(turn) && std::isfinite(way);
    if (!finite || depth == deepest || poses_.size() >= largest) {
      // A jump stays steady in the shortest interval and counts as resolved.
      resolved_ = resolved_ && (!finite || (steady && depth == deepest));
      poses_.push_back(b);
      return;
    }
    const int parts = std::clamp(static_cast<int>(std::ceil(turn / most)), 2, 128);
    At here = a;
    for (int i = 1; i <= parts; ++i) {
      const At next = i == parts ? b : at(motion, a.share + i * length / parts);
      refine(motion, here, next, finest, depth + 1);
      here = next;
    }
  }

  std::vector<At> poses_;
  Real begin_ = 0, end_ = 0;
  bool turns_ = false, resolved_ = true;
};

}  // namespace stickslip::rigid
