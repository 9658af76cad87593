// SPDX-License-Identifier: BSL-1.0
// Files are written whole or not at all, are nobody else's, and are the same under every locale.
#include <stickslip/io/flow_points.hpp>
#include <stickslip/io/gmsh.hpp>
#include <stickslip/io/new_file.hpp>
#include <stickslip/io/stl.hpp>

#include <doctest/doctest.h>

#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <set>
#include <sstream>

#include "locale.hpp"

namespace {

using namespace stickslip;
namespace fs = std::filesystem;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("stickslip_files_" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(path)) found.insert(entry.path().filename());
    return found;
  }
};

std::string text_of(const fs::path& path) {
  return io::detail::read_all(path);
}
void put(const fs::path& path, const std::string& text) {
  io::write_file(path, [&](std::ostream& out) { out << text; });
}
template <class Act>
std::string said(Act&& act) {
  try {
    act();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing";
}

TEST_CASE("a file is the old one until the new one is complete") {
  const Folder folder;
  const auto file = folder.path / "a";
  put(file, "old");
  {
    io::NewFile next(file);
    next.stream() << "new" << std::flush;
    CHECK(text_of(file) == "old");
    CHECK(folder.names().size() == 2);
    next.place();
    CHECK(text_of(file) == "new");
    CHECK(folder.names() == std::set<std::string>{"a"});
  }
  {
    io::NewFile given_up(file);
    given_up.stream() << std::string(100000, 'x') << std::flush;
  }
  CHECK(text_of(file) == "new");
  CHECK(folder.names() == std::set<std::string>{"a"});
  // Its permissions stay.
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  put(file, "private");
  CHECK(fs::status(file).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  // More than a buffer's length, in numbers and at once.
  io::NewFile large(file);
  std::string wanted;
  for (int i = 0; i < 20000; ++i) large.stream() << i << ' ', wanted += std::to_string(i) + ' ';
  const std::string block(100000, 'y');
  large.write(block);
  large.place(true);
  CHECK(text_of(file) == wanted + block);
}

TEST_CASE("a full disc leaves the old file and nothing beside it") {
  const Folder folder;
  const auto file = folder.path / "a";
  put(file, "old");
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{.rlim_cur = 1000, .rlim_max = before.rlim_max};
  REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  const std::string words = said([&] { put(file, std::string(100000, 'x')); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(words == "cannot write " + file.string() + ": File too large");
  CHECK(text_of(file) == "old");
  CHECK(folder.names() == std::set<std::string>{"a"});
}

TEST_CASE("links and other things at the place of a file are neither followed nor replaced") {
  const Folder folder;
  const auto file = folder.path / "a", victim = folder.path / "victim";
  put(victim, "untouched");
  // Under the name that unfinished files had.
  fs::create_symlink(victim, folder.path / "a.partial");
  put(file, "new");
  CHECK(text_of(victim) == "untouched");
  fs::remove(folder.path / "a.partial");
  REQUIRE(::mkfifo((folder.path / "a.partial").c_str(), 0600) == 0);
  put(file, "newer");  // does not wait for a reader
  CHECK(text_of(file) == "newer");

  // A link is to a file, which is written.
  fs::create_symlink(victim, folder.path / "link");
  put(folder.path / "link", "through the link");
  CHECK(fs::is_symlink(folder.path / "link"));
  CHECK(text_of(victim) == "through the link");
  fs::create_symlink(folder.path / "nowhere", folder.path / "dangling");
  CHECK(said([&] { put(folder.path / "dangling", ""); }) ==
        "cannot write " + (folder.path / "dangling").string() + ": it is a link to a file that does not exist");
  // Devices and pipes stay what they are.
  fs::create_symlink("/dev/null", folder.path / "device");
  for (const fs::path& path : {folder.path / "device", fs::path("/dev/null"), folder.path / "a.partial"}) {
    CHECK(said([&] { put(path, ""); }) == "cannot write " + path.string() + ": it is no regular file");
    CHECK(said([&] { io::check_writable(path); }) == "cannot write " + path.string() + ": it is no regular file");
  }
  CHECK(fs::is_character_file("/dev/null"));
  CHECK(fs::is_fifo(folder.path / "a.partial"));
  CHECK(said([&] { put(folder.path, ""); }) == "cannot write " + folder.path.string() + ": Is a directory");
  CHECK(said([&] { put(file / "b", ""); }) == "cannot write " + (file / "b").string() + ": Not a directory");

  // Results may go to a pipe.
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const fs::path pipe = "/dev/fd/" + std::to_string(ends[1]);
  io::check_writable(pipe, io::Target::any);
  {
    io::NewFile out(pipe, io::Target::any);
    out.stream() << "results";
    out.place();
  }
  char read[8]{};
  CHECK(::read(ends[0], read, 7) == 7);
  CHECK(std::string(read) == "results");
  ::close(ends[0]);
  ::close(ends[1]);
  io::NewFile full("/dev/full", io::Target::any);
  full.stream() << "results";
  CHECK(said([&] { full.place(); }) == "cannot write /dev/full: No space left on device");
}

TEST_CASE("the check whether a file can be written leaves no trace") {
  const Folder folder;
  put(folder.path / "a", "old");
  for (const char* name : {"a", "b"}) io::check_writable(folder.path / name);
  CHECK(folder.names() == std::set<std::string>{"a"});
  CHECK(text_of(folder.path / "a") == "old");
  CHECK(said([&] { io::check_writable(folder.path / "no" / "b"); }) ==
        "cannot write " + (folder.path / "no" / "b").string() + ": No such file or directory");
  // What killed runs left goes, and nothing else.
  const std::string left = "a.partial-0123456789abcdef";
  for (const std::string& name : {left, "b" + left, left + "0", std::string("a.partial-0123456789abcdeF"),
                                  std::string("a.partial-"), std::string("a.partial")})
    put(folder.path / name, "");
  fs::create_symlink("a", folder.path / "a.partial-0000000000000000");
  auto wanted = folder.names();
  wanted.erase(left);
  io::remove_partials(folder.path, "a");
  CHECK(folder.names() == wanted);
  wanted.erase("b" + left);
  io::remove_partials(folder.path);
  CHECK(folder.names() == wanted);
}

TEST_CASE("a folder belongs to one run, and that of a dead run is taken over") {
  const Folder folder;
  const auto lock = folder.path / "lock";
  int ready[2];
  REQUIRE(::pipe(ready) == 0);
  const pid_t other = ::fork();
  if (other == 0) {
    const io::RunLock held(lock, folder.path);
    (void)!::write(ready[1], "x", 1);
    for (;;) ::pause();
  }
  char token = 0;
  REQUIRE(::read(ready[0], &token, 1) == 1);
  CHECK(text_of(lock) == std::to_string(other) + "\n");
  const std::string words = said([&] { const io::RunLock mine(lock, folder.path); });
  CHECK(words == folder.path.string() + " is in use by another run, process " + std::to_string(other) + " (" +
                     lock.string() + ")");
  ::kill(other, SIGKILL);
  ::waitpid(other, nullptr, 0);
  CHECK(fs::exists(lock));
  {
    const io::RunLock mine(lock, folder.path);
    CHECK(text_of(lock) == std::to_string(::getpid()) + "\n");
    CHECK(said([&] { const io::RunLock again(lock, folder.path); }).find("in use by another run") != std::string::npos);
  }
  CHECK(!fs::exists(lock));
  // Whatever a file of that name says, nobody holds it.
  for (const char* stale : {"", "999999999\n", "words", "1\n"}) {
    put(lock, stale);
    const io::RunLock mine(lock, folder.path);
    CHECK(text_of(lock) == std::to_string(::getpid()) + "\n");
  }
  // What is no file is not touched.
  put(folder.path / "victim", "untouched");
  fs::create_symlink(folder.path / "victim", lock);
  CHECK(said([&] { const io::RunLock mine(lock, folder.path); }).find("cannot be locked by") != std::string::npos);
  CHECK(text_of(folder.path / "victim") == "untouched");
  fs::remove(lock);
  REQUIRE(::mkfifo(lock.c_str(), 0600) == 0);
  CHECK(said([&] { const io::RunLock mine(lock, folder.path); }).ends_with(": it is no regular file"));
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST_CASE("files are read and written alike under a locale with decimal commas") {
  const Folder folder;
  const WithCommas commas;
  const auto file = folder.path / "a";
  io::write_file(file, [](std::ostream& out) { out << 1681 << ' ' << 0.5 << ' ' << 1234567.5 << ' ' << true; });
  CHECK(text_of(file) == "1681 0.5 1.23457e+06 1");

  const rigid::Triangles flat{
      .vertices = {{0, 0, 0}, {1234.5, 0, 0}, {0, 0.25, 0}}, .corners = {{0, 1, 2}}, .normals = {}};
  io::write_stl(file, flat, io::StlFormat::ascii);
  CHECK(text_of(file).find("vertex 1234.5 0 0") != std::string::npos);
  CHECK(io::read_stl(file).vertices == flat.vertices);
  put(file, "0 10.5\n0.125 1200.5\n0.25 1300\n1.5 1400\n");
  const auto points = io::read_flow_points(file);
  REQUIRE(points.size() == 4);
  CHECK(points[1].strain == 0.125);
  CHECK(points[1].stress == 1200.5);
  put(file,
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1234.5 0 0\n3 1234.5 0.5 0\n4 0 0.5 0\n$EndNodes\n"
      "$Elements\n1\n1000 3 1 1 1 2 3 4\n$EndElements\n");
  CHECK(io::read_gmsh<2>(file).nodes[2] == Vec<Real, 2>(1234.5, 0.5));
}

}  // namespace
