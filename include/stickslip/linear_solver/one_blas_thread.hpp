// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <mutex>

extern "C" {
// Functions of OpenBLAS; null where the program does not link it.
[[gnu::weak]] int openblas_get_num_threads();
[[gnu::weak]] void openblas_set_num_threads(int);
}

namespace stickslip {

/// Limits OpenBLAS to one thread during its lifetime: OpenBLAS divides sums among its threads, so the bits of a
/// solution would depend on their number. That number is global to the process, hence the reference count. Define
/// STICKSLIP_BLAS_THREADS to leave the threads to OpenBLAS: large three-dimensional systems are then factorised faster.
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
