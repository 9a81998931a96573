#pragma once

namespace bight {

/// Runs f(i) for i in [0, count), where asked for by the threads of the region around.
template <class F>
void for_each(int count, bool parallel, F&& f) {
  if (!parallel || count < 2) {
    for (int i = 0; i < count; ++i) f(i);
    return;
  }
#pragma omp taskloop grainsize(1) default(shared)
  for (int i = 0; i < count; ++i) f(i);
}

}  // namespace bight
