// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/io/text.hpp>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/crc.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/tracking.hpp>
#include <boost/serialization/vector.hpp>
#include <boost/serialization/version.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace boost::serialization {
template <class BoostArchive>
void serialize(BoostArchive& archive, stickslip::Section& section, unsigned) {
  archive& section.name& section.size& section.count& section.bytes;
}
}  // namespace boost::serialization
BOOST_CLASS_VERSION(stickslip::Section, 1)
BOOST_CLASS_TRACKING(stickslip::Section, boost::serialization::track_never)

/// Restart files: a frame of 40 bytes around a binary archive of Boost.Serialization (docs/checkpoints.md). Link
/// stickslip::checkpoint.
namespace stickslip::io {

/// Of the format. It counts up whenever the sections of a march or what they mean change; other versions are refused.
inline constexpr std::uint32_t checkpoint_version = 3;

namespace detail {

inline constexpr std::string_view checkpoint_magic = "stickslip state\n";

/// What stands before the archive.
struct CheckpointFrame {
  char magic[16]{};
  std::uint32_t version = 0;
  std::uint32_t byte_order = 0;
  std::uint64_t length = 0;       ///< of the archive [bytes]
  std::uint32_t checksum = 0;     ///< of the archive, CRC-32
  std::uint32_t frame_check = 0;  ///< of the frame up to here
};
static_assert(sizeof(CheckpointFrame) == 40);
inline constexpr std::uint32_t this_byte_order = 0x01020304;

inline std::uint32_t crc(const void* bytes, std::size_t count) {
  boost::crc_32_type sum;
  sum.process_bytes(bytes, count);
  return sum.checksum();
}

/// A file that is being written, under another name until it is whole. What goes wrong is thrown as one sentence with
/// the final name.
class NewFile {
 public:
  explicit NewFile(std::filesystem::path path) : path_(std::move(path)), partial_(path_) {
    partial_ += ".partial";
    file_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file_ < 0) fail();
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile() {
    if (file_ >= 0) ::close(file_);
    if (!placed_) ::unlink(partial_.c_str());
  }

  void write(const char* bytes, std::size_t count) {
    while (count > 0) {
      const ssize_t written = ::write(file_, bytes, count);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail();
      bytes += written;
      count -= static_cast<std::size_t>(written);
    }
  }
  /// Puts it in the place of the old one, which stays whole until then whatever happens.
  void place() {
    if (!flushed(file_)) fail();
    const int file = std::exchange(file_, -1);
    if (::close(file) != 0) fail();
    if (std::rename(partial_.c_str(), path_.c_str()) != 0) fail();
    placed_ = true;
    // The new name as well should outlive a loss of power; some file systems cannot be asked for that.
    const auto folder = path_.has_parent_path() ? path_.parent_path() : std::filesystem::path(".");
    if (const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); handle >= 0) {
      (void)flushed(handle);
      ::close(handle);
    }
  }

 private:
  static bool flushed(int file) {
    int result = 0;
    while ((result = ::fsync(file)) != 0 && errno == EINTR) {
    }
    return result == 0;
  }
  [[noreturn]] void fail() const {
    throw std::runtime_error("cannot write " + path_.string() + ": " + std::generic_category().message(errno));
  }

  std::filesystem::path path_, partial_;
  int file_ = -1;
  bool placed_ = false;
};

}  // namespace detail

/// Writes a state to a file: to FILE.partial, flushed to the disc and renamed, so that at every moment FILE is the old
/// one or the new one, whole. Throws std::runtime_error, naming the file, when it cannot be written.
inline void write_checkpoint(const std::filesystem::path& path, const Archive& archive) {
  std::ostringstream out;
  boost::archive::binary_oarchive(out) << archive.sections;
  const std::string_view payload = out.view();
  detail::CheckpointFrame frame;
  frame.version = checkpoint_version;
  frame.byte_order = detail::this_byte_order;
  frame.length = payload.size();
  frame.checksum = detail::crc(payload.data(), payload.size());
  std::memcpy(frame.magic, detail::checkpoint_magic.data(), sizeof(frame.magic));
  frame.frame_check = detail::crc(&frame, offsetof(detail::CheckpointFrame, frame_check));
  detail::NewFile file(path);
  file.write(reinterpret_cast<const char*>(&frame), sizeof(frame));
  file.write(payload.data(), payload.size());
  file.place();
}

/// Reads the bytes of a file that `write_checkpoint` wrote. Throws std::runtime_error, one sentence that begins with
/// `name`, for anything else and for what has been damaged.
inline Archive read_checkpoint(std::string_view bytes, const std::string& name) {
  const auto refuse = [&](const std::string& what) { throw std::runtime_error(name + " " + what); };
  const std::string_view magic = detail::checkpoint_magic;
  if (bytes.substr(0, magic.size()) != magic.substr(0, bytes.size()) || bytes.empty())
    refuse("is not a restart file of stickslip");
  detail::CheckpointFrame frame;
  if (bytes.size() < sizeof(frame)) refuse("is cut off after " + std::to_string(bytes.size()) + " bytes");
  std::memcpy(&frame, bytes.data(), sizeof(frame));
  if (frame.byte_order != detail::this_byte_order && frame.byte_order == 0x04030201)
    refuse("was written by a machine of another byte order");
  if (frame.frame_check != detail::crc(&frame, offsetof(detail::CheckpointFrame, frame_check)))
    refuse("is damaged: the checksum of its first 40 bytes is wrong");
  if (frame.version != checkpoint_version)
    refuse("is of version " + std::to_string(frame.version) + " of the format, this program reads version " +
           std::to_string(checkpoint_version));
  const std::string_view payload = bytes.substr(sizeof(frame));
  if (payload.size() < frame.length)
    refuse("is cut off: it has " + std::to_string(bytes.size()) + " bytes of " +
           std::to_string(frame.length + sizeof(frame)));
  if (payload.size() > frame.length)
    refuse("is damaged: it has " + std::to_string(payload.size() - frame.length) + " bytes too many");
  if (frame.checksum != detail::crc(payload.data(), payload.size())) refuse("is damaged: its checksum is wrong");
  Archive archive;
  archive.origin = name;
  try {
    std::istringstream in{std::string(payload)};
    boost::archive::binary_iarchive(in) >> archive.sections;
  } catch (const std::exception& error) {  // of another version of Boost, say
    refuse(std::string("cannot be read by this program's Boost.Serialization: ") + error.what());
  }
  return archive;
}
inline Archive read_checkpoint(const std::filesystem::path& path) {
  return read_checkpoint(detail::read_all(path), path.string());
}

/// Writes the state of a march between two steps, and that of whatever else belongs to the run and has a `serialize`
/// (Archive). Call it in the loop over the steps, where it is due, and after the loop, where the march may have failed:
/// the file then holds the state before the step that failed. Throws std::runtime_error, naming the file.
template <class March, class... More>
void save(const std::filesystem::path& path, March& march, More&... more) {
  write_checkpoint(path, Archive::of(march, more...));
}

/// Makes a march, and what else was saved with it, continue where the file says, bit for bit. The march is one of a
/// problem that has been put together as the saved one was, with the options of the saved march. Throws
/// std::runtime_error, one sentence with the file and the reason; march and problem are then as they were.
template <class March, class... More>
void load(const std::filesystem::path& path, March& march, More&... more) {
  read_checkpoint(path).restore(march, more...);
}

}  // namespace stickslip::io
