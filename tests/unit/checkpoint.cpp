// SPDX-License-Identifier: BSL-1.0
// A run that is restarted from a file continues bit for bit; a file that is not whole, or of something else, is refused
// by a sentence and nothing is touched.
#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/io/checkpoint.hpp>
#include <stickslip/io/vtu.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>
#include <stickslip/problem.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>
#include <stickslip/time_integration/quasistatic.hpp>

#include <doctest/doctest.h>

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "locale.hpp"

namespace {

using namespace stickslip;
namespace fs = std::filesystem;

// A folder of the test's own, gone at its end.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("stickslip_checkpoint_" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

// A law whose memory owns memory: it says itself how it is kept.
struct OwningState {
  using Role = role::Material;
  static constexpr Symmetry symmetry = Symmetry::symmetric;
  FiniteJ2<LinearHardening> law{};

  template <class S, class TensorPattern>
  struct State {
    FiniteJ2<LinearHardening>::State<S, TensorPattern> inner{};
    std::vector<Real> strains{};
    void serialize(Archive& archive) {
      archive("inner", inner);
      archive.resizable("strains", strains);
    }
  };
  template <class S, class TensorPattern>
  MaterialResponse<S, TensorPattern, State<S, TensorPattern>> respond(const Tensor<S, TensorPattern>& F,
                                                                      const State<S, TensorPattern>& old,
                                                                      Real dt) const {
    const auto inner = law.respond(F, old.inner, dt);
    MaterialResponse<S, TensorPattern, State<S, TensorPattern>> out{
        inner.P, inner.dP_dF, {inner.state, old.strains}, inner.cause};
    if (dt > 0) out.state.strains.push_back(value_of(inner.state.plastic_strain));
    return out;
  }
};

// A solver whose answers depend on how many there were.
struct Tiring : EigenLdlt {
  Index solved = 0;
  bool solve(const Real* right_hand_side, Real* solution) {
    const bool good = EigenLdlt::solve(right_hand_side, solution);
    ++solved;
    solution[0] *= 1 - 1e-9 * solved;
    return good;
  }
  void serialize(Archive& archive) { archive("solved", solved); }
};

struct Plane {
  using Kinematics = PlaneStrain;
  using Element = MeanDilatation<Quad4>;
  using Material = FiniteJ2<LinearHardening>;
  using Friction = QuasiCoulomb;
  using Enforcement = Penalty;
  using TimeIntegration = Quasistatic;
  using LinearSolver = EigenLdlt;
};
struct Dynamic : Plane {
  using LinearSolver = EigenLu;
  using Kinematics = Axisymmetric;
  using Material = HypoelasticJ2<LinearHardening>;
  using Friction = ExtrapolatedCoulomb;
  using TimeIntegration = GeneralizedAlpha;
};
struct Multipliers : Plane {
  using Element = FullyIntegrated<Quad4>;
  using Material = OwningState;
  using LinearSolver = Tiring;
  using Friction = WithPressure<Coulomb, LagIterated>;
  using Enforcement = AugmentedLagrangian;
};
struct Bending : Plane {
  using Element = AssumedStrain<Quad4>;
};
struct Space : Plane {
  using Kinematics = ThreeDimensional;
  using Element = MeanDilatation<Hex8>;
  using Friction = PerContact<Coulomb, Frictionless, QuasiCoulomb>;
  using LinearSolver = EigenLu;
};

template <class Model, class Friction>
Contact<Model, Friction> roller(const std::string& side, Real lost_from) {
  constexpr int dim = Model::Kinematics::dim;
  const auto surface = [&] {
    if constexpr (dim == 2)
      return rigid::disc({2, 4.02}, 3);
    else if (side == "top")
      return rigid::cylinder({1, 2.02, 0}, {0, 0, 1}, 1);
    else
      return rigid::cylinder({3.02, 0.5, 0}, {0, 0, 1}, 1);
  };
  Contact<Model, Friction> contact{.side = side, .tool = surface(), .name = side + " tool"};
  // Presses for a third of the time, then drags.
  contact.motion = [lost_from, sideways = side != "top"](Real t) {
    Vec<Real, dim> x = Vec<Real, dim>::Zero();
    x[sideways ? 0 : 1] = -0.25 * std::min(t, 0.3);
    x[sideways ? 1 : 0] = 0.4 * std::max(0.0, t - 0.3);
    if (t > lost_from) x[0] = std::numeric_limits<Real>::quiet_NaN();
    // The one in the middle of the top turns besides: the way of its surface is followed.
    rigid::Pose<dim> pose;
    if (!sideways && (dim == 2 || std::same_as<Friction, Coulomb>)) {
      const Real angle = 5 * std::max(0.0, t - 0.3);
      Vec<Real, dim> centre = Vec<Real, dim>::Zero();
      centre.template head<2>() << (dim == 2 ? 2 : 1), (dim == 2 ? 4.02 : 2.02);
      pose.rotation.template topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle),
          std::cos(angle);
      x += centre - pose.rotation * centre;
    }
    pose.translation = x;
    return pose;
  };
  contact.enforcement.normal = 5;
  contact.enforcement.tangential = 1;
  contact.enforcement.per = PenaltyPer::stiffness;
  if constexpr (Friction::active) contact.friction.mu = 0.2;
  return contact;
}

/// A block under a disc that is pressed and dragged; in space under three rollers of a law each.
template <class Model>
std::unique_ptr<Problem<Model>> scene(Index cells = 6, Real lost_from = 2) {
  constexpr int dim = Model::Kinematics::dim;
  typename Problem<Model>::Parameters p;
  if constexpr (dim == 2)
    p.body = mesh::rectangle({.origin = {1, 0}, .size = {3, 1}, .cells = {cells, 2}});
  else
    p.body = mesh::box({.size = {2, 1, 1}, .cells = {4, 2, 1}});
  const auto j2 = [](auto& law) {
    law.young = 1000;
    law.poisson = 0.3;
    law.hardening = {.yield = 5, .modulus = 50};
  };
  if constexpr (requires { p.material.law; })
    j2(p.material.law);
  else
    j2(p.material);
  if constexpr (has_inertia<Model>) p.density = 0.5;
  if constexpr (requires { Model::Friction::per_contact; }) {
    std::get<0>(p.contacts).push_back(roller<Model, Coulomb>("top", lost_from));
    std::get<1>(p.contacts).push_back(roller<Model, Frictionless>("right", lost_from));
    std::get<2>(p.contacts).push_back(roller<Model, QuasiCoulomb>("top", lost_from));
    std::get<2>(p.contacts)[0].name = "other";
    std::get<2>(p.contacts)[0].tool = rigid::cylinder({0.2, 2.05, 0}, {0, 0, 1}, 1);
  } else {
    p.contacts.push_back(roller<Model, typename Model::Friction>("top", lost_from));
  }
  auto problem = std::make_unique<Problem<Model>>(std::move(p));
  for (Index i = 0; i < dim; ++i) problem->hold("bottom", i);
  problem->load("left", 0, [](Real t) { return 0.5 * t; });
  return problem;
}

const MarchOptions automatic{
    .end = 1, .initial = 0.02, .largest = 0.08, .mesh_error_interval = 3, .stops = {0.31, 0.77}};
const MarchOptions equal{.end = 1, .steps = 25};

// Bits of a run, but for the times that it took.
template <class Model>
std::vector<Section> bits(March<Model>& march) {
  std::vector<Section> kept = Archive::of(march).sections;
  for (Section& s : kept)
    if (s.name == "run, sums") {
      Archive sums;
      sums.sections = {s};
      RunReport report;
      struct {
        RunReport& report;
        void serialize(Archive& archive) { archive("run, sums", report); }
      } part{report};
      sums.restore(part);
      report.timings = {};
      s = Archive::of(part).sections[0];
    }
  return kept;
}
void check_equal(const std::vector<Section>& a, const std::vector<Section>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    INFO(a[k].name);
    CHECK((a[k].name == b[k].name && a[k].bytes == b[k].bytes));
  }
}

template <class Model>
void continues_bit_for_bit(const MarchOptions& options, std::initializer_list<Index> saves) {
  const Folder folder;
  const auto file = [&](Index step) { return folder.path / std::to_string(step); };
  auto whole = scene<Model>();
  auto march = whole->march(options);
  CHECK(march.finish());
  CHECK(march.report().steps > *(saves.end() - 1));
  CHECK(whole->max_plastic_strain() > (requires { Model::Material::law; } ? -1 : 1e-3));
  if constexpr (requires { Model::Friction::per_contact; }) CHECK(whole->contact("other").summary().touching > 0);
  const auto wanted = bits(march);

  // Saving changes nothing; what is saved later takes the place of the earlier.
  auto saved = scene<Model>();
  auto saving = saved->march(options);
  for (const StepReport& step : saving)
    for (const Index at : saves)
      if (step.number == at) io::save(file(at), saving);
  check_equal(wanted, bits(saving));
  io::save(file(0), saving);

  for (const Index at : saves) {
    INFO("saved at step ", at);
    auto fresh = scene<Model>();
    auto restarted = fresh->march(options);
    io::load(file(at), restarted);
    CHECK(restarted.report().steps == at);
    CHECK(fresh->time() > 0);
    auto it = restarted.begin();
    CHECK(it->number == at + 1);
    CHECK(restarted.finish());
    check_equal(wanted, bits(restarted));
  }
  // A run that is complete stays so.
  auto fresh = scene<Model>();
  auto ended = fresh->march(options);
  io::load(file(0), ended);
  CHECK(ended.begin() == ended.end());
  CHECK(ended.outcome());
  check_equal(wanted, bits(ended));
}

TEST_CASE("lagged friction and plasticity continue bit for bit") {
  continues_bit_for_bit<Plane>(automatic, {1, 7, 12});
  continues_bit_for_bit<Plane>(equal, {10});
}
TEST_CASE("inertia, a rate law and an extrapolated bound continue bit for bit") {
  continues_bit_for_bit<Dynamic>(automatic, {1, 2, 10});
}
// The memory owns memory, and the solver has one.
TEST_CASE("multipliers and iterated bounds continue bit for bit") {
  continues_bit_for_bit<Multipliers>(automatic, {2, 8});
  continues_bit_for_bit<Multipliers>(equal, {13});
}
TEST_CASE("the condensed unknowns of an element that bends continue bit for bit") {
  continues_bit_for_bit<Bending>(automatic, {1, 7});
}
TEST_CASE("contacts in space with a law each continue bit for bit") {
  continues_bit_for_bit<Space>(automatic, {4, 9});
}

TEST_CASE("a run that failed leaves the state before the step that failed") {
  const Folder folder;
  const auto file = folder.path / "failed";
  const auto lost = scene<Plane>(6, 0.5);
  auto march = lost->march(automatic);
  CHECK(!march.finish());
  CHECK(march.outcome().failure.cause == FailureCause::not_finite);
  const Index rejected = march.report().rejected_steps, attempts = march.outcome().attempts;
  io::save(file, march);
  // With the same tool it fails in the same way.
  const auto again = scene<Plane>(6, 0.5);
  auto repeated = again->march(automatic);
  io::load(file, repeated);
  CHECK(repeated.outcome());
  CHECK(!repeated.finish());
  CHECK(repeated.outcome().message() == march.outcome().message());
  check_equal(bits(march), bits(repeated));
  // With a sound one it goes on, by steps as large as before.
  const auto sound = scene<Plane>();
  auto cured = sound->march(automatic);
  io::load(file, cured);
  auto it = cured.begin();
  CHECK(it->rejected == 0);
  CHECK(cured.finish());
  CHECK(sound->time() == 1);
  // A march that failed can take the state again.
  io::load(file, march);
  CHECK(march.outcome());
  CHECK(march.report().rejected_steps == rejected - attempts);
}

std::string read(const fs::path& path) {
  return io::detail::read_all(path);
}
void write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

// Loads into a march that is under way, and expects one sentence and nothing else.
template <class Model>
void refused(March<Model>& march, const fs::path& path, const std::string& words) {
  const auto before = bits(march);
  std::string said;
  try {
    io::load(path, march);
  } catch (const std::runtime_error& error) {
    said = error.what();
  }
  INFO(said);
  CHECK(said.find(path.string()) != std::string::npos);
  CHECK(said.find(words) != std::string::npos);
  CHECK(said.size() < 700);
  for (const char c : said) CHECK(static_cast<unsigned char>(c) >= ' ');
  const auto after = bits(march);
  bool same = before.size() == after.size();
  for (std::size_t k = 0; same && k < before.size(); ++k) same = before[k].bytes == after[k].bytes;
  CHECK(same);
}

struct Saved {
  Folder folder;
  fs::path file = folder.path / "run.restart", bad = folder.path / "bad";
  std::unique_ptr<Problem<Plane>> problem = scene<Plane>();
  March<Plane> march = problem->march(equal);
  Saved() {
    auto other = scene<Plane>();
    auto run = other->march(equal);
    for (const StepReport& step : run)
      if (step.number == 8) break;
    io::save(file, run);
    march.begin();
  }
};

TEST_CASE("a damaged restart file is refused, and the problem stays as it was") {
  Saved s;
  const std::string whole = read(s.file);
  CHECK(whole.size() > 2000);
  for (std::size_t k = 0; k < 50; ++k) {
    const std::size_t length = k < 20 ? 3 * k : whole.size() * (k - 19) / 31 - 1;
    write(s.bad, whole.substr(0, length));
    refused(s.march, s.bad, length == 0 ? "is not a restart file" : "is cut off");
  }
  std::mt19937 random(1);
  for (std::size_t k = 0; k < 200; ++k) {
    std::string bytes = whole;
    const std::size_t at = k < 40 ? k : random() % bytes.size();
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
    write(s.bad, bytes);
    refused(s.march, s.bad, at < 16 ? "is not a restart file of stickslip" : "is damaged");
  }
  write(s.bad, whole + "x");
  refused(s.march, s.bad, "is damaged: it has 1 bytes too many");
  write(s.bad, "<?xml version=\"1.0\"?>\n<VTKFile/>\n");
  refused(s.march, s.bad, "is not a restart file of stickslip");
  refused(s.march, s.folder.path / "gone", "cannot read");
  refused(s.march, s.folder.path, "cannot read");

  // Another version of the format, and checksums that are right around something else.
  const auto framed = [](std::string payload, std::uint32_t version) {
    io::detail::CheckpointFrame frame;
    std::memcpy(frame.magic, io::detail::checkpoint_magic.data(), 16);
    frame.version = version;
    frame.byte_order = io::detail::this_byte_order;
    frame.length = payload.size();
    frame.checksum = io::detail::crc(payload.data(), payload.size());
    frame.frame_check = io::detail::crc(&frame, 36);
    return std::string(reinterpret_cast<const char*>(&frame), sizeof(frame)) + payload;
  };
  CHECK(framed(whole.substr(40), io::checkpoint_version) == whole);
  for (const std::uint32_t version : {3u, 7u}) {
    write(s.bad, framed(whole.substr(40), version));
    refused(s.march, s.bad,
            "is of version " + std::to_string(version) + " of the format, this program reads version " +
                std::to_string(io::checkpoint_version));
  }
  for (const std::string& payload : {std::string(), "\x16" + std::string(7, '\0') + "another kind of archive",
                                     whole.substr(40, 1000), whole.substr(40) + "x"}) {
    write(s.bad, framed(payload, io::checkpoint_version));
    refused(s.march, s.bad, "is damaged: what it claims of its sections is not what it has");
  }
  // Counts that lie, behind checksums that are right: of sections, and of the first one's name, layout, size and
  // values.
  for (const std::size_t at : {0u, 8u, 16u, 24u, 32u})
    for (const std::uint64_t lie : {std::uint64_t(1) << 40, std::uint64_t(1) << 63, ~std::uint64_t(0)}) {
      std::string payload = whole.substr(40);
      std::memcpy(payload.data() + at, &lie, sizeof(lie));
      write(s.bad, framed(payload, io::checkpoint_version));
      refused(s.march, s.bad, "is damaged: what it claims of its sections is not what it has");
    }
  // The product of size and count is that of the bytes, but only beyond 64 bits.
  std::string wrapped = whole.substr(40);
  for (const std::size_t at : {24u, 32u}) {
    const std::uint64_t half = std::uint64_t(1) << 32;
    std::memcpy(wrapped.data() + at, &half, sizeof(half));
  }
  write(s.bad, framed(wrapped, io::checkpoint_version));
  refused(s.march, s.bad, "is damaged: what it claims of its sections is not what it has");
  // What a section of another kind is called is shown on one line, and not for ever.
  Archive foreign;
  Real value = 1;
  foreign("kine\nmatics" + std::string(5000, 'x'), value);
  io::write_checkpoint(s.bad, foreign);
  refused(s.march, s.bad, "it has \"kine?maticsxxx");
  // A section whose values have other members, of as many bytes.
  Archive other = io::read_checkpoint(s.file);
  const auto step = std::find_if(other.sections.begin(), other.sections.end(),
                                 [](const Section& section) { return section.name == "run, last step"; });
  REQUIRE(step != other.sections.end());
  CHECK(step->layout == layout<StepReport>());
  step->layout.replace(step->layout.find("rejected"), 8, "given\nup");
  io::write_checkpoint(s.bad, other);
  refused(s.march, s.bad,
          "its \"run, last step\" has values of other members or types, \"given?up i4, outer_iterations i4");
  step->layout = "";
  io::write_checkpoint(s.bad, other);
  refused(s.march, s.bad, "its \"run, last step\" has values of other members or types, \"\" where");
  step->layout = layout<StepReport>();
  --step->size;
  step->bytes.resize(static_cast<std::size_t>(step->size));
  io::write_checkpoint(s.bad, other);
  refused(s.march, s.bad, "its \"run, last step\" is of values of 179 bytes, this run's of 180");
}

TEST_CASE("the checksum is that of zlib") {
  CHECK(io::detail::crc("123456789", 9) == 0xcbf43926U);  // the check value of CRC-32/ISO-HDLC
  CHECK(io::detail::crc("", 0) == 0);
}

TEST_CASE("a restart file replaces nothing that is no regular file") {
  Saved s;
  const auto link = s.folder.path / "link", device = s.folder.path / "device";
  fs::create_symlink("/dev/null", device);
  CHECK_THROWS_WITH_AS(io::save(device, s.march),
                       ("cannot write " + device.string() + ": it is no regular file").c_str(), std::runtime_error);
  CHECK_THROWS_WITH_AS(io::save("/dev/null", s.march), "cannot write /dev/null: it is no regular file",
                       std::runtime_error);
  CHECK(fs::is_character_file("/dev/null"));
  const std::string old = read(s.file);
  fs::create_symlink(s.file, link);
  io::save(link, s.march);
  CHECK(fs::is_symlink(link));
  CHECK(read(s.file) != old);
}

TEST_CASE("files for ParaView are complete XML with decimal points in every locale") {
  Saved s;
  auto large = scene<Plane>(600);  // 1803 nodes: there are thousands to be parted
  const auto points = s.folder.path / "a < b & \"c\"_0000.vtu", collection = s.folder.path / "a < b & \"c\".pvd";
  {
    const WithCommas commas;
    io::VtuSeries series(s.folder.path, "a < b & \"c\"");
    series.write(*large);
    s.march.finish();
    io::VtuSeries times(s.folder.path, "times");
    times.write(*s.problem);
    io::save(s.bad, s.march);
    io::load(s.bad, s.march);
  }
  CHECK(read(points).find("NumberOfPoints=\"1803\" NumberOfCells=\"1200\"") != std::string::npos);
  CHECK(read(collection).find("file=\"a &lt; b &amp; &quot;c&quot;_0000.vtu\"") != std::string::npos);
  CHECK(read(s.folder.path / "times.pvd").find("timestep=\"1\"") != std::string::npos);
  {
    const WithCommas commas;
    auto half = scene<Plane>();
    auto march = half->march({.end = 0.5, .steps = 25});
    march.finish();
    io::VtuSeries times(s.folder.path, "times");
    times.write(*half);
  }
  CHECK(read(s.folder.path / "times.pvd").find("timestep=\"0.5\"") != std::string::npos);
  for (const std::string name : {"a/b", "a\x01", "\xff", "\xc0\x80", "\xed\xa0\x80"})
    CHECK_THROWS_AS(io::VtuSeries(s.folder.path, name), std::invalid_argument);
  CHECK_NOTHROW(io::VtuSeries(s.folder.path, "Ofenrohr \xc3\x9f \xe2\x82\xac \xf0\x9f\x98\x80"));
  CHECK_THROWS_WITH_AS(io::VtuSeries(s.file / "deeper", "a"),
                       ("cannot write " + (s.file / "deeper").string() + ": Not a directory").c_str(),
                       std::runtime_error);

  // A disc that is full leaves no torn file, and the old one.
  const std::string old = read(points);
  const auto files = std::distance(fs::directory_iterator(s.folder.path), {});
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{.rlim_cur = 1000, .rlim_max = before.rlim_max};
  REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  std::string said;
  try {
    io::write_vtu(points, *s.problem);
  } catch (const std::runtime_error& error) {
    said = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(said == "cannot write " + points.string() + ": File too large");
  CHECK(read(points) == old);
  CHECK(std::distance(fs::directory_iterator(s.folder.path), {}) == files);
}

TEST_CASE("blocks that were not joined give a warning") {
  Problem<Plane>::Parameters p;
  p.body = mesh::rectangle({.size = {2, 1}, .cells = {2, 1}});
  p.material = {.young = 1000, .poisson = 0.3, .hardening = {.yield = 5, .modulus = 50}};
  const auto march_of = [&] {
    auto problem = std::make_unique<Problem<Plane>>(p);
    return problem->march(equal).warnings();
  };
  CHECK(march_of().empty());
  for (const Index n : {2, 3}) {
    p.body.nodes.push_back(p.body.nodes[static_cast<std::size_t>(n)]);
    for (Index& of_cell : p.body.cells[1])
      if (of_cell == n) of_cell = p.body.node_count() - 1;
  }
  const auto warnings = march_of();
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].name == "coincident_nodes");
  CHECK(warnings[0].step == 0);
  CHECK(warnings[0].text.starts_with("2 nodes of the mesh lie where another one does, nodes "));
}

TEST_CASE("restart files of another run are refused") {
  Saved s;
  auto fine = scene<Plane>(8);
  auto on_fine = fine->march(equal);
  refused(on_fine, s.file, "its mesh is \"21 nodes, 12 cells, ");
  auto automatically = scene<Plane>();
  auto run = automatically->march(automatic);
  refused(run, s.file, "its choice of steps is \"25 equal steps\", here it is \"automatic\"");
  auto held = scene<Plane>();
  held->hold("left", 0);
  auto march = held->march(equal);
  refused(march, s.file, "its supports is");
  auto multipliers = scene<Multipliers>();
  auto other = multipliers->march(equal);
  refused(other, s.file, "its element is \"stickslip::MeanDilatation<stickslip::Quad4>\", here");

  // One that kept less beside the march, and one that kept more.
  std::vector<Real> kept{1, 2};
  struct Beside {
    std::vector<Real>& list;
    void serialize(Archive& archive) { archive.resizable("beside", list); }
  } beside{kept};
  CHECK_THROWS_WITH_AS(io::load(s.file, s.march, beside), doctest::Contains("it lacks \"beside\""), std::runtime_error);
  io::save(s.file, s.march, beside);
  refused(s.march, s.file, "has \"beside\", which this run has not");
  kept = {};
  io::load(s.file, s.march, beside);
  CHECK(kept == std::vector<Real>{1, 2});
}

TEST_CASE("a restart file that cannot be written leaves the old one") {
  Saved s;
  const std::string old = read(s.file);
  CHECK_THROWS_WITH_AS(io::save(s.folder.path / "no" / "folder", s.march), doctest::Contains("cannot write"),
                       std::runtime_error);
  // A disc that is full half-way, by the limit of the size of files.
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{.rlim_cur = 1000, .rlim_max = before.rlim_max};
  REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  std::string said;
  try {
    io::save(s.file, s.march);
  } catch (const std::runtime_error& error) {
    said = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  INFO(said);
  CHECK(said.starts_with("cannot write " + s.file.string() + ": "));
  CHECK(read(s.file) == old);
  CHECK(std::distance(fs::directory_iterator(s.folder.path), {}) == 1);
  io::save(s.file, s.march);
  CHECK(read(s.file) != old);
}

}  // namespace
