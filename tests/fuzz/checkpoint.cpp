// SPDX-License-Identifier: BSL-1.0
// Restart files. What is read fits the run or is refused in a sentence, and a refusal leaves the run as it was. The
// first byte of an input says what the others are: a file; an archive, whose frame and checksums are made right; or
// changes to the archive of the run that it is handed to, three bytes each, so that what is restored is damaged in its
// depth.
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/io/checkpoint.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/problem.hpp>
#include <stickslip/time_integration/quasistatic.hpp>

#include <string>
#include <vector>

#include "target.hpp"

using namespace stickslip;

namespace {

struct Model {
  using Kinematics = PlaneStrain;
  using Element = MeanDilatation<Quad4>;
  using Material = FiniteJ2<LinearHardening>;
  using Friction = QuasiCoulomb;
  using Enforcement = Penalty;
  using TimeIntegration = Quasistatic;
  using LinearSolver = EigenLdlt;
};

// A block under a disc, two steps on its way, with a list that grows.
struct Run {
  Problem<Model> problem{{.body = mesh::rectangle({.size = {2, 1}, .cells = {2, 1}}),
                          .material = {.young = 1000, .poisson = 0.3, .hardening = {.yield = 5, .modulus = 50}},
                          .contacts = {{.side = "top",
                                        .tool = rigid::disc({1, 4.02}, 3),
                                        .motion = [](Real t) { return Vec<Real, 2>(0, -0.1 * t); },
                                        .friction = {.mu = 0.2},
                                        .enforcement = {.normal = 100, .tangential = 10}}}}};
  March<Model> march = begun();
  std::vector<Real> times{0, 0.5};

  Run() {
    for (const StepReport& step : march)
      if (step.number == 2) break;
    fuzz::require(static_cast<bool>(march.outcome()), "the run goes well");
  }
  March<Model> begun() {
    problem.hold("bottom", 0).hold("bottom", 1);
    return problem.march({.end = 1, .steps = 10});
  }
  void serialize(Archive& archive) {
    march.serialize(archive);
    archive.resizable("times", times);
  }
};

std::string state(Run& run) {
  return io::detail::pack(Archive::of(run).sections);
}

// `good` is the run's own archive, and `before` its bytes.
void read(std::string_view bytes, Run& run, Archive& good, const std::string& before) {
  const std::string name = "input.restart";
  fuzz::reader<std::runtime_error>(
      bytes, name,
      [](std::istream& in, const std::string& n) { return io::read_checkpoint(io::detail::read_all(in, n), n); },
      [&](Archive archive) {
        std::size_t size = 0;
        for (const Section& s : archive.sections) {
          fuzz::require(s.size * s.count == s.bytes.size(), "sections have the bytes that they claim");
          size += s.bytes.size() + s.name.size();
        }
        fuzz::require(size <= bytes.size(), "an archive is no larger than its file");
        fuzz::require(io::detail::framed(io::detail::pack(archive.sections)) == bytes,
                      "a file that is read says one thing");
        try {
          archive.restore(run);
        } catch (const std::runtime_error& error) {
          fuzz::require_sentence(error.what());
          fuzz::require(std::string(error.what()).starts_with(name), "a complaint begins with the name of the file");
          fuzz::require(state(run) == before, "a file that is refused changes nothing");
          return;
        }
        for (const Warning& warning : run.march.warnings()) fuzz::require(warning.text.size() <= size, "words are few");
        good.restore(run);
        fuzz::require(state(run) == before, "a run can go back");
      });
}

// Three bytes a change: where, in two, and what. The place 0xffff cuts the archive off in 256ths, 0xfffe makes it
// longer.
std::string changed(std::string archive, std::string_view changes) {
  for (; changes.size() >= 3; changes.remove_prefix(3)) {
    const auto byte = [&](std::size_t k) { return static_cast<std::size_t>(static_cast<unsigned char>(changes[k])); };
    const std::size_t place = byte(0) << 8 | byte(1);
    if (place == 0xffff)
      archive.resize(archive.size() * byte(2) / 256);
    else if (place == 0xfffe)
      archive.append(byte(2), 'x');
    else if (!archive.empty())
      archive[place % archive.size()] = changes[2];
  }
  return archive;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Run run;
  static Archive good = Archive::of(run);
  good.restore(run);
  static const std::string before = state(run);
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 3) {
    case 0:
      read(bytes, run, good, before);
      break;
    case 1:
      read(io::detail::framed(bytes), run, good, before);
      break;
    default:
      read(io::detail::framed(changed(before, bytes)), run, good, before);
  }
  return 0;
}
