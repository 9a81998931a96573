#pragma once

#include <omp.h>

namespace bight::rod1d {

/// While it lives, this thread's parallel regions (and those of BLAS) have one thread: an iteration
/// of a rod takes a millisecond or two, and waking threads would cost more.
class OneThread {
 public:
  OneThread() : threads_(omp_get_max_threads()) { omp_set_num_threads(1); }
  ~OneThread() { omp_set_num_threads(threads_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int threads_;
};

}  // namespace bight::rod1d
