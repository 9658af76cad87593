// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <locale>
#include <ostream>
#include <random>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

/// Writing of files: completely or not at all, in the classic locale, and by one run at a time.
namespace stickslip::io {

namespace detail {

/// The system's message for an error number, such as "No space left on device".
inline std::string reason(int error) {
  return std::generic_category().message(error);
}

/// Writes all bytes to a descriptor. Returns 0 or the error number.
inline int write_all(int file, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(file, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return 0;
}

inline constexpr std::string_view partial_mark = ".partial-";
inline constexpr std::size_t partial_digits = 16;

/// Stream buffer that writes to a descriptor; keeps the first error.
class DescriptorBuffer : public std::streambuf {
 public:
  int file = -1, error = 0;
  DescriptorBuffer() { setp(block_.data(), block_.data() + block_.size()); }

 protected:
  int_type overflow(int_type c) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }
  int sync() override {
    if (error == 0) error = write_all(file, pbase(), static_cast<std::size_t>(pptr() - pbase()));
    setp(block_.data(), block_.data() + block_.size());
    return error == 0 ? 0 : -1;
  }

 private:
  std::array<char, 1 << 14> block_{};
};

}  // namespace detail

/// What may exist at the path of a new file: nothing or a regular file, or with `any` also a device or a pipe, which is
/// written to directly.
enum class Target { regular, any };

/// A file written under a temporary name beside its path, NAME.partial- and 16 digits, which `place()` renames to the
/// path. So the path names the complete old file or the complete new one at every moment; after an error the old file
/// remains and the temporary file is removed. A link is followed to its target, which keeps its permissions. Numbers
/// are written in the classic locale, whatever the global one is. Throws std::runtime_error with the file and the
/// reason.
class NewFile {
 public:
  explicit NewFile(std::filesystem::path path, Target target = Target::regular)
      : path_(std::move(path)), place_(path_), out_(&buffer_) {
    out_.imbue(std::locale::classic());
    struct ::stat old {};
    const bool there = ::stat(path_.c_str(), &old) == 0;
    if (!there && errno != ENOENT) fail(errno);
    struct ::stat link {};
    if (!there && ::lstat(path_.c_str(), &link) == 0) refuse("it is a link to a file that does not exist");
    if (there && S_ISDIR(old.st_mode)) fail(EISDIR);
    if (there && (!S_ISREG(old.st_mode) || is_descriptor())) {
      if (target == Target::regular) refuse("it is no regular file");
      buffer_.file = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
      if (buffer_.file < 0) fail(errno);
      return;
    }
    std::error_code error;
    if (there) place_ = std::filesystem::canonical(path_, error);
    if (error) fail(error.value());
    std::random_device random;
    do {  // O_EXCL refuses the file of another run and any link at this name
      std::array<char, detail::partial_digits> digits{};
      for (char& digit : digits) digit = "0123456789abcdef"[random() % 16];
      partial_ = place_;
      partial_ += std::string(detail::partial_mark).append(digits.data(), digits.size());
      buffer_.file = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    } while (buffer_.file < 0 && errno == EEXIST);
    if (buffer_.file < 0) {
      partial_.clear();
      fail(errno);
    }
    if (there) (void)::fchmod(buffer_.file, old.st_mode & 0777);
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile() {
    if (buffer_.file >= 0) ::close(buffer_.file);
    if (!partial_.empty()) ::unlink(partial_.c_str());
  }

  std::ostream& stream() { return out_; }
  void write(std::string_view bytes) { out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); }

  /// Renames the file to its path; if `durable`, flushed to the disc so that it survives a loss of power.
  void place(bool durable = false) {
    out_.flush();
    if (buffer_.error != 0) fail(buffer_.error);
    if (!out_) fail(EIO);
    if (durable && !flushed(buffer_.file)) fail(errno);
    const int file = std::exchange(buffer_.file, -1);
    if (::close(file) != 0) fail(errno);
    if (partial_.empty()) return;
    if (std::rename(partial_.c_str(), place_.c_str()) != 0) fail(errno);
    partial_.clear();
    if (!durable) return;
    // Flushes the new name as well; some file systems do not support that.
    const auto folder = place_.has_parent_path() ? place_.parent_path() : std::filesystem::path(".");
    if (const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); handle >= 0) {
      (void)flushed(handle);
      ::close(handle);
    }
  }

 private:
  // Whether the path names an open descriptor of a process: /dev/stdout, /dev/fd/5.
  bool is_descriptor() const {
    const std::string text = std::filesystem::absolute(path_).lexically_normal().string();
    return text.starts_with("/dev/") || text.starts_with("/proc/");
  }
  static bool flushed(int file) {
    int result = 0;
    while ((result = ::fsync(file)) != 0 && errno == EINTR) {
    }
    return result == 0;
  }
  [[noreturn]] void refuse(const std::string& why) const {
    throw std::runtime_error("cannot write " + path_.string() + ": " + why);
  }
  // Called in the constructor only with nothing to release: the destructor does not run then.
  [[noreturn]] void fail(int error) const { refuse(detail::reason(error)); }

  std::filesystem::path path_, place_, partial_;
  detail::DescriptorBuffer buffer_;
  std::ostream out_;
};

/// Writes a file completely or not at all (NewFile); write(std::ostream&) writes the contents.
template <class Write>
void write_file(const std::filesystem::path& path, Write&& write) {
  NewFile file(path);
  write(file.stream());
  file.place();
}

/// Throws std::runtime_error, naming the file and the reason, if the path is not writable now; leaves no file.
inline void check_writable(const std::filesystem::path& path, Target target = Target::regular) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  // Opening a pipe would wait for its reader.
  if (target == Target::any && std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
      !std::filesystem::is_directory(status)) {
    if (::access(path.c_str(), W_OK) != 0)
      throw std::runtime_error("cannot write " + path.string() + ": " + detail::reason(errno));
    return;
  }
  const NewFile file(path, target);
}

/// Removes the temporary files that killed runs have left: all in the folder, or those of the file `name`. The caller
/// must hold the lock of the folder or the file.
inline void remove_partials(const std::filesystem::path& folder, const std::string& name = "") {
  std::error_code error;
  for (std::filesystem::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end;
       at.increment(error)) {
    const std::string found = at->path().filename().string();
    const std::size_t mark = found.rfind(detail::partial_mark), digits = mark + detail::partial_mark.size();
    std::error_code ignored;
    if (mark == found.npos || found.size() - digits != detail::partial_digits ||
        found.find_first_not_of("0123456789abcdef", digits) != found.npos ||
        (!name.empty() && found.substr(0, mark) != name) || !std::filesystem::is_regular_file(at->symlink_status()))
      continue;
    std::filesystem::remove(at->path(), ignored);
  }
}

/// Reserves a folder or a file for one run. The lock is a file with the process number, locked by the system as long as
/// the process lives; the file of a killed run is taken over. The destructor removes it.
class RunLock {
 public:
  /// `lock` is the lock file, `of` the reserved folder or file. Throws std::runtime_error, beginning with `of` and
  /// naming the process, if another run holds the lock, or with the reason if it cannot be made.
  RunLock(std::filesystem::path lock, const std::filesystem::path& of) : path_(std::move(lock)) {
    const auto refuse = [&](const std::string& why) {
      if (file_ >= 0) ::close(std::exchange(file_, -1));
      throw std::runtime_error(of.string() + " cannot be locked by " + path_.string() + ": " + why);
    };
    for (;;) {
      file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644);
      if (file_ < 0) refuse(detail::reason(errno));
      struct ::stat ours {};
      if (::fstat(file_, &ours) != 0) refuse(detail::reason(errno));
      if (!S_ISREG(ours.st_mode)) refuse("it is no regular file");
      if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
        const int error = errno;
        const int owner = read_owner();
        // Some file systems have no locks: there the process number decides.
        const bool held =
            error == EWOULDBLOCK || (owner > 0 && owner != ::getpid() && (::kill(owner, 0) == 0 || errno == EPERM));
        if (held) {
          ::close(std::exchange(file_, -1));
          throw std::runtime_error(of.string() + " is in use by another run, process " +
                                   (owner > 0 ? std::to_string(owner) : "unknown") + " (" + path_.string() + ")");
        }
      }
      // The previous run may have removed the file between open and lock.
      struct ::stat now {};
      if (::lstat(path_.c_str(), &now) == 0 && now.st_ino == ours.st_ino && now.st_dev == ours.st_dev) break;
      ::close(std::exchange(file_, -1));
    }
    const std::string owner = std::to_string(::getpid()) + "\n";
    if (::ftruncate(file_, 0) != 0) refuse(detail::reason(errno));
    if (::lseek(file_, 0, SEEK_SET) != 0) refuse(detail::reason(errno));
    if (const int error = detail::write_all(file_, owner.data(), owner.size())) refuse(detail::reason(error));
  }
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;
  ~RunLock() {
    ::unlink(path_.c_str());
    ::close(file_);
  }

 private:
  int read_owner() const {
    std::array<char, 16> text{};
    const ssize_t count = ::pread(file_, text.data(), text.size(), 0);
    int owner = 0;
    if (count > 0) (void)std::from_chars(text.data(), text.data() + count, owner);
    return owner;
  }

  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace stickslip::io
