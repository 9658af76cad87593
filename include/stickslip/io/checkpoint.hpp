// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/io/new_file.hpp>
#include <stickslip/io/text.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Restart files: a header of 40 bytes and the sections of an archive (docs/checkpoints.md).
namespace stickslip::io {

/// Version of the format. It increases whenever the layout of the file, the sections of a march or their meaning
/// change; other versions are refused.
inline constexpr std::uint32_t checkpoint_version = 4;

namespace detail {

inline constexpr std::string_view checkpoint_magic = "stickslip state\n";

/// Header before the archive.
struct CheckpointFrame {
  char magic[16]{};
  std::uint32_t version = 0;
  std::uint32_t byte_order = 0;
  std::uint64_t length = 0;       ///< of the archive [bytes]
  std::uint32_t checksum = 0;     ///< of the archive, CRC-32
  std::uint32_t frame_check = 0;  ///< of the header up to here, CRC-32
};
static_assert(sizeof(CheckpointFrame) == 40);
inline constexpr std::uint32_t this_byte_order = 0x01020304;

// CRC-32 of zlib: polynomial 0xedb88320, reflected.
inline std::uint32_t crc(const void* bytes, std::size_t count) {
  static constexpr auto table = [] {
    std::array<std::uint32_t, 256> values{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) value = (value & 1) != 0 ? value >> 1 ^ 0xedb88320U : value >> 1;
      values[i] = value;
    }
    return values;
  }();
  std::uint32_t sum = 0xffffffffU;
  const auto* at = static_cast<const unsigned char*>(bytes);
  for (std::size_t k = 0; k < count; ++k) sum = table[(sum ^ at[k]) & 0xffU] ^ sum >> 8;
  return ~sum;
}

inline void put(std::string& bytes, std::uint64_t value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}
inline std::string pack(const std::vector<Section>& sections) {
  std::string bytes;
  put(bytes, sections.size());
  for (const Section& s : sections) {
    for (const std::uint64_t value : {std::uint64_t(s.name.size()), std::uint64_t(s.layout.size()), s.size, s.count})
      put(bytes, value);
    bytes.append(s.name).append(s.layout).append(s.bytes.data(), s.bytes.size());
  }
  return bytes;
}

// Reads sections from the bytes of an archive; checks every count against the bytes that are left.
class Unpacking {
 public:
  explicit Unpacking(std::string_view bytes) : bytes_(bytes) {}

  // False if the bytes are not an archive.
  bool read(std::vector<Section>& sections) {
    std::uint64_t count = 0;
    if (!take(count) || count > bytes_.size() / (4 * sizeof(count))) return false;
    sections.reserve(static_cast<std::size_t>(count));
    for (std::uint64_t k = 0; k < count; ++k) {
      std::uint64_t name = 0, layout = 0;
      Section s;
      if (!take(name) || !take(layout) || !take(s.size) || !take(s.count) || name > bytes_.size()) return false;
      s.name = next(static_cast<std::size_t>(name));
      if (layout > bytes_.size()) return false;
      s.layout = next(static_cast<std::size_t>(layout));
      if (s.size == 0 ? s.count != 0 : s.count > bytes_.size() / s.size) return false;
      const std::string_view values = next(static_cast<std::size_t>(s.size * s.count));
      s.bytes.assign(values.begin(), values.end());
      sections.push_back(std::move(s));
    }
    return bytes_.empty();
  }

 private:
  bool take(std::uint64_t& value) {
    if (bytes_.size() < sizeof(value)) return false;
    std::memcpy(&value, bytes_.data(), sizeof(value));
    bytes_.remove_prefix(sizeof(value));
    return true;
  }
  std::string_view next(std::size_t count) {
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::string_view bytes_;
};

// The bytes of a file: the header and those of an archive.
inline std::string framed(std::string_view payload) {
  CheckpointFrame frame;
  frame.version = checkpoint_version;
  frame.byte_order = this_byte_order;
  frame.length = payload.size();
  frame.checksum = crc(payload.data(), payload.size());
  std::memcpy(frame.magic, checkpoint_magic.data(), sizeof(frame.magic));
  frame.frame_check = crc(&frame, offsetof(CheckpointFrame, frame_check));
  return std::string(reinterpret_cast<const char*>(&frame), sizeof(frame)).append(payload);
}

}  // namespace detail

/// Writes a state to a file: under a temporary name, flushed to the disc and renamed, so that the path names the
/// complete old file or the complete new one at every moment (NewFile). Throws std::runtime_error, naming the file, if
/// it cannot be written, for example because it is a device.
inline void write_checkpoint(const std::filesystem::path& path, const Archive& archive) {
  NewFile file(path);
  file.write(detail::framed(detail::pack(archive.sections)));
  file.place(true);
}

/// Reads the bytes of a file of `write_checkpoint`. Throws std::runtime_error, beginning with `name`, for any other
/// file and for a damaged one. Memory is proportional to the size of the file.
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
  if (frame.byte_order != detail::this_byte_order) refuse("is damaged: its byte order is none");
  const std::string_view payload = bytes.substr(sizeof(frame));
  if (payload.size() < frame.length)
    refuse("is cut off: it has " + std::to_string(bytes.size()) + " bytes of " +
           std::to_string(frame.length + sizeof(frame)));
  if (payload.size() > frame.length)
    refuse("is damaged: it has " + std::to_string(payload.size() - frame.length) + " bytes too many");
  if (frame.checksum != detail::crc(payload.data(), payload.size())) refuse("is damaged: its checksum is wrong");
  Archive archive;
  archive.origin = name;
  if (!detail::Unpacking(payload).read(archive.sections))
    refuse("is damaged: what it claims of its sections is not what it has");
  return archive;
}
inline Archive read_checkpoint(const std::filesystem::path& path) {
  return read_checkpoint(detail::read_all(path), path.string());
}

/// Writes the state of a march between two steps, and of other objects of the run that have a `serialize` (Archive).
/// Call it in the loop over the steps, when due, and after the loop, where the march may have failed: the file then
/// holds the state before the failed step. Throws std::runtime_error, naming the file.
template <class March, class... More>
void save(const std::filesystem::path& path, March& march, More&... more) {
  write_checkpoint(path, Archive::of(march, more...));
}

/// Restores a march, and the objects saved with it, to continue from the file bit for bit. The problem of the march
/// must be set up as the saved one was, with the options of the saved march. Throws std::runtime_error with the file
/// and the reason; march and problem are then unchanged.
template <class March, class... More>
void load(const std::filesystem::path& path, March& march, More&... more) {
  read_checkpoint(path).restore(march, more...);
}

}  // namespace stickslip::io
