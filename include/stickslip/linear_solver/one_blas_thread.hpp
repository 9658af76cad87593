// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <mutex>

extern "C" {
// OpenBLAS's, where the program has it.
[[gnu::weak]] int openblas_get_num_threads();
[[gnu::weak]] void openblas_set_num_threads(int);
}

namespace stickslip {

/// While one lives, OpenBLAS works with one thread, so that the bits of a solution do not depend on how many it has: it
/// shares sums out among them. The number is the process's own, hence the count of those who hold it at one. Define
/// STICKSLIP_BLAS_THREADS to leave the threads to the library: large systems in space are factorised sooner then.
class OneBlasThread {
 public:
#ifdef STICKSLIP_BLAS_THREADS
  OneBlasThread() {}
#else
  OneBlasThread() {
    if (!openblas_set_num_threads || !openblas_get_num_threads) return;
    const std::lock_guard lock(mutex_);
    if (holders_++ > 0) return;
    before_ = openblas_get_num_threads();
    if (before_ > 1) openblas_set_num_threads(1);
  }
  ~OneBlasThread() {
    if (!openblas_set_num_threads || !openblas_get_num_threads) return;
    const std::lock_guard lock(mutex_);
    if (--holders_ == 0 && before_ > 1) openblas_set_num_threads(before_);
  }
#endif
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  static inline std::mutex mutex_;
  static inline int holders_ = 0, before_ = 1;
};

}  // namespace stickslip
