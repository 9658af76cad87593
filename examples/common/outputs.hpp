// SPDX-License-Identifier: BSL-1.0
// The files that a run writes: checked before it begins, and kept to it until it ends.
#pragma once

#include "options.hpp"

#include <stickslip/io/new_file.hpp>

#include <exception>
#include <optional>
#include <string>
#include <vector>

namespace examples {

/// Finds out before a run whether what it is asked for can be written, and locks folder and restart file against other
/// runs, until it is destroyed. While it runs a file that cannot be written is told and noted, and the run goes on: it
/// is worth more than a picture.
class Outputs {
 public:
  /// Throws std::runtime_error, one sentence with the file and the reason.
  Outputs(const Options& options, std::string program);

  /// Calls write(); a failure of it is told: the first at once, the others by their number. Returns whether all went
  /// well.
  template <class Write>
  bool attempt(Write&& write) {
    try {
      write();
      return true;
    } catch (const std::exception& error) {
      note(error.what());
      return false;
    }
  }
  /// A sentence for each file that could not be written.
  const std::vector<std::string>& missing() const { return missing_; }

 private:
  void note(const std::string& what);

  std::string program_;
  bool on_line_ = false;  // progress stands on the line
  std::optional<stickslip::io::RunLock> folder_, checkpoint_;
  std::vector<std::string> missing_;
};

}  // namespace examples
